#include "datasets/gallery/face_gallery.h"

#include "core/files.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stop_token>

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
  for (const char* name : {"identities.jpg", "expressions.jpg", "levels.jpg", "caricatures.jpg", "curves.jpg"}) {
    const render::Image picture = render::ReadImage(folder_ / "out" / name);
    EXPECT_GT(picture.width, 300) << name;
    const auto [darkest, lightest] = std::minmax_element(picture.pixels.begin(), picture.pixels.end());
    EXPECT_GT(*lightest - *darkest, 100) << name << " shows nothing";
  }
}

TEST_F(Gallery, ListsItsPicturesAndIsReplacedByThem) {
  const faces::FaceDatabase faces(folder_ / "faces");
  const std::filesystem::path out = folder_ / "out";
  EXPECT_NO_THROW(CheckGalleryFolder(out, {folder_ / "faces"}));
  WriteGallery(faces, nullptr, out);
  const Manifest manifest = ReadManifest(out, "gallery");
  EXPECT_EQ(manifest.checksums.size(), 5u);
  EXPECT_NO_THROW(VerifyChecksums(out, manifest));
  EXPECT_NO_THROW(CheckGalleryFolder(out, {folder_ / "faces"}));
  WriteFileAtomically(out / "sketches.jpg", "mine");
  testing::ExpectError([&] { CheckGalleryFolder(out, {}); }, "sketches.jpg is not listed");
  std::filesystem::remove(out / "sketches.jpg");
  std::filesystem::remove(out / "manifest.json");
  testing::ExpectError([&] { CheckGalleryFolder(out, {}); }, "is not empty and holds no earlier gallery");
}

TEST_F(Gallery, PicturesOfAnotherOriginAreNotOverwritten) {
  const std::filesystem::path out = folder_ / "out";
  for (const char* name : {"identities.jpg", "expressions.jpg", "levels.jpg", "caricatures.jpg", "curves.jpg"})
    WriteFileAtomically(out / name, "mine");
  testing::ExpectError([&] { CheckGalleryFolder(out, {}); }, "is not empty and holds no earlier gallery");
}

TEST_F(Gallery, AStoppedOneCanBeMadeAgain) {
  const faces::FaceDatabase faces(folder_ / "faces");
  const std::filesystem::path out = folder_ / "out";
  std::stop_source source;
  const auto stop_after_the_first = [&](const TaskProgress& progress) {
    if (progress.done == 1) source.request_stop();
  };
  testing::ExpectError([&] { WriteGallery(faces, nullptr, out, Task(source.get_token(), stop_after_the_first)); },
                       "stopped after 1 of 5 pictures");
  EXPECT_TRUE(std::filesystem::exists(out / "identities.jpg"));
  EXPECT_FALSE(std::filesystem::exists(out / "levels.jpg"));
  EXPECT_NO_THROW(CheckGalleryFolder(out, {})) << "what is there is its own";
  WriteGallery(faces, nullptr, out);
  const Manifest manifest = ReadManifest(out, "gallery");
  EXPECT_EQ(manifest.checksums.size(), 5u);
  EXPECT_TRUE(manifest.details.empty());
}

}  // namespace
}  // namespace daumier::datasets
