#include "systems/portrait/picture_files.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(PictureFiles, ArePicturesOfTheFolderInTheOrderOfTheirNumbers) {
  const testing::TempDir folder;
  MakeDirectory(folder / "below.png");
  for (const char* name : {"10.JPG", "9.png", "notes.txt", ".hidden.png", "9.pts"})
    WriteFileAtomically(folder / name, "x");
  std::vector<std::string> names;
  for (const auto& file : PicturesIn(folder.path())) names.push_back(file.filename().string());
  EXPECT_EQ(names, (std::vector<std::string>{"9.png", "10.JPG"}));
  testing::ExpectError([&] { PicturesIn(folder / "absent"); }, "absent is no folder of pictures");
}

TEST(PictureFiles, FoldersThatAreNamedHaveToExist) {
  const testing::TempDir folder;
  EXPECT_NO_THROW(CheckFolders({"", folder.path().string()}));
  testing::ExpectError([&] { CheckFolders({"", (folder / "nix").string()}); }, "there is no folder");
}

TEST(PictureFiles, TheFirstFileOfLandmarksIsTaken) {
  const testing::TempDir folder;
  EXPECT_FALSE(LandmarkFileIn(folder.path(), "a"));
  for (const char* extension : {".json", ".txt", ".pts"}) {
    WriteFileAtomically(folder / (std::string("a") + extension), "x");
    EXPECT_EQ(LandmarkFileIn(folder.path(), "a"), folder / (std::string("a") + extension));
  }
}

TEST(PictureFiles, EachExtensionIsOneThatImagesAreReadFrom) {
  const testing::TempDir folder;
  for (const std::string& extension : PictureExtensions()) EXPECT_TRUE(IsPictureFile("a" + extension));
  EXPECT_FALSE(IsPictureFile("a.svg"));
  render::WriteImage(folder / "a.png", render::Image(5, 7, 3, 90));
  const std::vector<systems::Input> inputs = ReadPicture(folder / "a.png");
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_EQ(std::get<render::Image>(inputs[0]), render::Image(5, 7, 3, 90));
}

}  // namespace
}  // namespace daumier::portrait
