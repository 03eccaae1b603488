#include "systems/portrait/landmark_files.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkFiles, ReadPtsUndoesWritingAndTextMayBeginWithTheCount) {
  const testing::TempDir folder;
  const std::vector<float> truth = testing::PlausibleLandmarks(10, 20, 60);
  WriteFileAtomically(folder / "a.pts", LandmarksAsPts(truth));
  std::string text = "68\n";
  for (size_t i = 0; i < truth.size(); i += 2) text += fmt::format("{} {}\n", truth[i], truth[i + 1]);
  WriteFileAtomically(folder / "b.txt", text);
  for (const char* name : {"a.pts", "b.txt"}) {
    const std::vector<float> read = ReadLandmarks(folder / name);
    for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(read[i], truth[i], 6e-4);
  }
  WriteFileAtomically(folder / "c.txt", "1 2\n3 4\n");
  testing::ExpectError([&] { ReadLandmarks(folder / "c.txt"); }, "has 2 points");
}

TEST(LandmarkFiles, AMaskHasThePicturesSizeAndClasses) {
  const testing::TempDir folder;
  render::WriteImage(folder / "m.png", render::Image(8, 9, 1, 7));
  EXPECT_EQ(ReadMask(folder / "m.png", 8, 9).at(3, 3), 7);
  testing::ExpectError([&] { ReadMask(folder / "m.png", 9, 8); }, "expected a grey picture of 9 x 8");
  render::WriteImage(folder / "n.png", render::Image(8, 9, 1, 8));
  testing::ExpectError([&] { ReadMask(folder / "n.png", 8, 9); }, "a pixel of class 8, expected 0 to 7");
}

}  // namespace
}  // namespace daumier::portrait
