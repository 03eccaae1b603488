#include "benchmark/kit.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_kit.h"

#include <gtest/gtest.h>

namespace daumier::benchmark {
namespace {

using testing::ExpectError;
using testing::SmallKit;

TEST(Kit, HasInputAndTruthOfEachItem) {
  const Kit kit(SmallKit());
  EXPECT_EQ(kit.name(), "small");
  for (size_t task = 0; task < kKitTaskNames.size(); ++task) {
    for (const KitItem& item : kit.items(KitTask(task), KitSplit::kTest)) {
      EXPECT_TRUE(std::filesystem::exists(kit.InputFile(KitTask(task), KitSplit::kTest, item))) << item.name;
      if (KitTask(task) == KitTask::kLandmarks) {
        EXPECT_GT(kit.TrueLandmarks(KitSplit::kTest, item)[0], 0);
      } else {
        EXPECT_EQ(kit.TrueFace(KitTask(task), KitSplit::kTest, item).rows(), kit.face_template().num_vertices());
      }
    }
  }
}

TEST(Kit, TruthIsRoundedToATenthOfAMicrometre) {
  const Kit kit(SmallKit());
  const KitItem& item = kit.items(KitTask::kDrawings, KitSplit::kTest).front();
  const geometry::Points face = kit.TrueFace(KitTask::kDrawings, KitSplit::kTest, item);
  EXPECT_LT((1e4 * face.array() - (1e4 * face.array()).round()).abs().maxCoeff(), 0.05);
}

TEST(Kit, NamesWhatIsWrong) {
  const testing::TempDir folder;
  ExpectError([&] { Kit{folder.path()}; }, "manifest.json");
  ExpectError([] { KitTaskNamed("drawing"); }, "expected drawings, caricatures, portraits, landmarks");
  ExpectError([] { KitSplitNamed("all"); }, "expected train, validation, test");
  std::filesystem::copy(SmallKit(), folder / "kit", std::filesystem::copy_options::recursive);
  Manifest manifest = ReadManifest(folder / "kit", kBenchmarkKind);
  manifest.details["version"] = 99;
  WriteManifest(folder / "kit", manifest);
  ExpectError([&] { Kit{folder / "kit"}; }, "version 99");
  manifest.details.erase("items");
  manifest.details["version"] = kBenchmarkVersion;
  WriteManifest(folder / "kit", manifest);
  ExpectError([&] { Kit{folder / "kit"}; }, "malformed");
}

TEST(PtsText, IsReadAgain) {
  const testing::TempDir folder;
  eval::LandmarkRow row;
  for (size_t i = 0; i < row.size(); ++i) row[i] = 0.125 * double(i) - 3;
  WriteFileAtomically(folder / "a.pts", PtsText(row));
  const eval::LandmarkRow again = ReadLandmarkRow(folder / "a.pts");
  for (size_t i = 0; i < row.size(); ++i) EXPECT_NEAR(again[i], row[i], 0.0006);
}

TEST(ReadLandmarkRow, NeedsAll68OfAPicture) {
  const testing::TempDir folder;
  std::string text;
  for (int i = 0; i < 68; ++i) text += i == 40 ? "nan nan\n" : "1 2\n";
  WriteFileAtomically(folder / "a.txt", text);
  ExpectError([&] { ReadLandmarkRow(folder / "a.txt"); }, "landmark 40 is absent");
  text.clear();
  for (int i = 0; i < 68; ++i) text += "1 2 3\n";
  WriteFileAtomically(folder / "a.txt", text);
  ExpectError([&] { ReadLandmarkRow(folder / "a.txt"); }, "expected x and y");
  WriteFileAtomically(folder / "a.txt", "1 2\n3 4\n");
  ExpectError([&] { ReadLandmarkRow(folder / "a.txt"); }, "a.txt");
}

}  // namespace
}  // namespace daumier::benchmark
