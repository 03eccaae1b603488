#include "datasets/gallery/sketch_gallery.h"

#include "render/image.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {
namespace {

class SketchGallery : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::BuildSyntheticFaces(folder_ / "faces", 3);
    testing::BuildSyntheticSketches(folder_ / "faces", folder_ / "sketches");
  }

  const testing::TempDir folder_;
};

TEST_F(SketchGallery, ShowsLinesAndWhatAugmentationMakesOfThem) {
  const faces::FaceDatabase faces(folder_ / "faces");
  const SketchDatabase sketches(folder_ / "sketches");
  const std::vector<GalleryPicture> pictures = SketchPictures(faces, sketches);
  ASSERT_EQ(pictures.size(), 6u);
  for (const auto& [name, draw] : pictures) {
    const render::Image picture = draw();
    EXPECT_GT(picture.width, 300) << name;
    const auto [darkest, lightest] = std::minmax_element(picture.pixels.begin(), picture.pixels.end());
    EXPECT_GT(*lightest - *darkest, 100) << name << " shows nothing";
  }
}

TEST_F(SketchGallery, RefusesSketchesOfAnotherDatabase) {
  testing::BuildSyntheticFaces(folder_ / "more", 4);
  const faces::FaceDatabase faces(folder_ / "more");
  const SketchDatabase sketches(folder_ / "sketches");
  testing::ExpectError([&] { SketchPictures(faces, sketches); }, "belong to another database");
}

}  // namespace
}  // namespace daumier::datasets
