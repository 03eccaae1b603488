#include "datasets/gallery/face_gallery.h"

#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::datasets {

namespace {

class Gallery : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::BuildSyntheticFaces(folder_ / "faces", 3);
    MakeDirectory(folder_ / "out");
  }

  const testing::TempDir folder_;
};

TEST_F(Gallery, ShowsWhatADatabaseHolds) {
  const faces::FaceDatabase faces(folder_ / "faces");
  WriteGallery(faces, nullptr, folder_ / "out");
  for (const char* name : {"identities.jpg", "expressions.jpg", "levels.jpg", "curves.jpg"}) {
    const render::Image picture = render::ReadImage(folder_ / "out" / name);
    EXPECT_GT(picture.width, 300) << name;
    const auto [darkest, lightest] = std::minmax_element(picture.pixels.begin(), picture.pixels.end());
    EXPECT_GT(*lightest - *darkest, 100) << name << " shows nothing";
  }
}

}  // namespace
}  // namespace daumier::datasets
