#include "datasets/gallery/portrait_gallery.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_portraits.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

class PortraitGallery : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::BuildSyntheticFaces(folder_ / "faces", 2);
    testing::BuildSyntheticPortraits(folder_ / "faces", folder_ / "portraits", 4);
  }
  const testing::TempDir folder_;
};

TEST_F(PortraitGallery, HasTheFirstPortraitsAndTheirTruth) {
  const PortraitDatabase database(folder_ / "portraits");
  MakeDirectory(folder_ / "gallery");
  CheckPortraitGalleryFolder(folder_ / "gallery", {folder_ / "portraits"});
  WritePortraitGallery(database, folder_ / "gallery");
  for (const char* name : {"portraits.jpg", "portrait_truth.jpg"}) {
    const render::Image sheet = render::ReadImage(folder_ / "gallery" / name);
    EXPECT_GT(sheet.width, 600) << name;
  }
  const Manifest manifest = ReadManifest(folder_ / "gallery", "gallery");
  EXPECT_EQ(manifest.counts.at("portraits"), 4);
  EXPECT_NO_THROW(VerifyChecksums(folder_ / "gallery", manifest));
  CheckPortraitGalleryFolder(folder_ / "gallery", {folder_ / "portraits"});
}

TEST_F(PortraitGallery, TruthShowsSeenLandmarksInGreen) {
  const PortraitDatabase database(folder_ / "portraits");
  const render::Image truth = PortraitTruth(database, 0);
  const std::vector<float> landmarks = database.landmarks(0);
  const std::vector<uint8_t> seen = database.visibility(0);
  int num_green = 0, num_seen = 0;
  for (size_t l = 0; l < seen.size(); ++l) {
    if (!seen[l]) continue;
    ++num_seen;
    num_green += truth.at(int(landmarks[2 * l + 1]), int(landmarks[2 * l]), 1) == 255;
  }
  EXPECT_GT(num_seen, 20);
  EXPECT_GE(num_green, num_seen - 4) << "hidden dots may cover some";
}

TEST_F(PortraitGallery, OtherFoldersAreLeftAlone) {
  MakeDirectory(folder_ / "mine");
  WriteFileAtomically(folder_ / "mine/letter.txt", "precious");
  EXPECT_THROW(CheckPortraitGalleryFolder(folder_ / "mine", {folder_ / "portraits"}), UsageError);
}

}  // namespace
}  // namespace daumier::datasets
