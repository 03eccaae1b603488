#include "systems/portrait/landmark_files.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
  EXPECT_EQ(LandmarksInFolder(folder.path(), "a"), ReadLandmarks(folder / "a.pts"));
  EXPECT_FALSE(LandmarksInFolder(folder.path(), "c"));
  WriteFileAtomically(folder / "c.txt", "1 2\n3 4\n");
  testing::ExpectError([&] { ReadLandmarks(folder / "c.txt"); }, "c.txt: 2 points");
}

TEST(LandmarkFiles, LandmarksThatAreAbsentAreNan) {
  const testing::TempDir folder;
  std::string text;
  for (int i = 0; i < kNumLandmarks; ++i) text += i == 36 ? "10 20.5\n" : i == 45 ? "90 20\n" : "nan nan\n";
  WriteFileAtomically(folder / "rows.txt", text);
  WriteFileAtomically(folder / "names.txt", "LM45 90 20\nLM36 10 20.5\nLM0 nan nan\n");
  for (const char* name : {"rows.txt", "names.txt"}) {
    const std::vector<float> known = ReadKnownLandmarks(folder / name);
    ASSERT_EQ(known.size(), 136u);
    EXPECT_EQ(known[72], 10);
    EXPECT_EQ(known[73], 20.5f);
    EXPECT_EQ(known[90], 90);
    EXPECT_EQ(std::ranges::count_if(known, [](float value) { return std::isfinite(value); }), 4);
    testing::ExpectError([&] { ReadLandmarks(folder / name); }, "landmark 1 of 68 is absent");
  }
}

TEST(LandmarkFiles, AMaskHasThePicturesSizeAndClasses) {
  const testing::TempDir folder;
  render::WriteImage(folder / "m.png", render::Image(8, 9, 1, 7));
  EXPECT_EQ(ReadMask(folder / "m.png", 8, 9).at(3, 3), 7);
  testing::ExpectError([&] { ReadMask(folder / "m.png", 9, 8); }, "expected a grey picture of 9 x 8");
  render::WriteImage(folder / "n.png", render::Image(8, 9, 1, 8));
  testing::ExpectError([&] { ReadMask(folder / "n.png", 8, 9); }, "a pixel of class 8, expected 0 to 7");
}

TEST(ReadHeadMask, TakesClassesOrBlackAndWhiteOfTheSameShape) {
  const daumier::testing::TempDir folder;
  const auto file = folder.path() / "mask.png";
  render::Image classes(4, 6, 1, uint8_t(PictureClass::kHair));
  classes.at(3, 5) = uint8_t(PictureClass::kSkin);
  render::WriteImage(file, classes);
  EXPECT_EQ(ReadHeadMask(file, 4, 6, std::nullopt), classes);
  const render::Image twice = ReadHeadMask(file, 8, 12, std::nullopt);
  EXPECT_EQ(twice.at(7, 11), uint8_t(PictureClass::kSkin));
  EXPECT_EQ(twice.at(5, 11), uint8_t(PictureClass::kHair));

  render::Image white(4, 6, 3, 255);
  for (int c = 0; c < 3; ++c) white.at(0, 0, c) = 0;
  render::WriteImage(file, white);
  render::Image parsed(4, 6, 1, uint8_t(PictureClass::kBackground));
  parsed.at(0, 0) = parsed.at(1, 1) = uint8_t(PictureClass::kLips);
  const render::Image within = ReadHeadMask(file, 4, 6, parsed);
  EXPECT_EQ(within.at(0, 0), uint8_t(PictureClass::kBackground)) << "black";
  EXPECT_EQ(within.at(1, 1), uint8_t(PictureClass::kLips));
  EXPECT_EQ(within.at(2, 2), uint8_t(PictureClass::kSkin));
}

TEST(ReadHeadMask, RefusesOthers) {
  const daumier::testing::TempDir folder;
  const auto file = folder.path() / "mask.png";
  const auto expect_refused = [&](const render::Image& mask, const std::string& part) {
    render::WriteImage(file, mask);
    daumier::testing::ExpectError([&] { ReadHeadMask(file, 4, 6, std::nullopt); }, part);
  };
  expect_refused(render::Image(4, 6, 1, 90), "has a pixel of the value 90");
  expect_refused(render::Image(4, 7, 1, 0), "expected the same shape");
  render::Image coloured(4, 6, 3, 10);
  coloured.at(0, 0, 1) = 200;
  expect_refused(coloured, "is a picture in colours");
}

TEST(ReadHeadMask, TakesSoftenedEdgesOfBlackAndWhite) {
  const daumier::testing::TempDir folder;
  const auto file = folder.path() / "mask.png";
  render::Image soft(20, 20, 1, 255);
  for (int row = 0; row < 20; ++row) soft.at(row, 0) = 3;
  soft.at(5, 1) = 90;
  soft.at(6, 1) = 160;
  render::WriteImage(file, soft);
  const render::Image mask = ReadHeadMask(file, 20, 20, std::nullopt);
  EXPECT_EQ(mask.at(5, 0), uint8_t(PictureClass::kBackground));
  EXPECT_EQ(mask.at(5, 1), uint8_t(PictureClass::kBackground));
  EXPECT_EQ(mask.at(6, 1), uint8_t(PictureClass::kSkin));
}

TEST(CheckLandmarks, RefusesThoseOfOtherPicturesAndMirroredOnes) {
  std::vector<float> landmarks(136, 50);
  for (size_t n = 36; n < 42; ++n) landmarks[2 * n] = 30;
  for (size_t n = 42; n < 48; ++n) landmarks[2 * n] = 70;
  landmarks[2 * 8 + 1] = 90;
  EXPECT_EQ(CheckLandmarks("a.pts", landmarks, 100, 100), "");
  EXPECT_NE(CheckLandmarks("a.pts", landmarks, 80, 100).find("1 of 68 landmarks are outside"), std::string::npos);
  std::vector<float> far = landmarks;
  far[2 * 30] = 1e6F;
  daumier::testing::ExpectError([&] { CheckLandmarks("a.pts", far, 100, 100); },
                                "a.pts: landmark 31 is at (1e+06, 50)");
  std::vector<float> mirrored = landmarks;
  for (size_t n = 0; n < 68; ++n) mirrored[2 * n] = 100 - landmarks[2 * n];
  daumier::testing::ExpectError([&] { CheckLandmarks("a.pts", mirrored, 100, 100); }, "mirrored face");
}

}  // namespace
}  // namespace daumier::portrait
