#include "studio/uploads.h"

#include "core/files.h"
#include "render/image.h"
#include "render/strokes.h"
#include "studio/api.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cctype>
#include <future>
#include <set>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

TEST(SafeFileName, HasNoFolderAndPlainCharactersAlone) {
  EXPECT_EQ(SafeFileName("face.png"), "face.png");
  EXPECT_EQ(SafeFileName("my face (1).PNG"), "my_face__1_.PNG");
  EXPECT_EQ(SafeFileName("/etc/passwd"), "passwd");
  EXPECT_EQ(SafeFileName("../../a.obj"), "a.obj");
  EXPECT_EQ(SafeFileName("C:\\photos\\a.jpg"), "a.jpg");
  EXPECT_EQ(SafeFileName("a\nb.csv"), "a_b.csv");
  EXPECT_EQ(SafeFileName(std::string_view("a\0b.csv", 7)), "a_b.csv");
}

TEST(SafeFileName, BeginsWithALetterOrDigit) {
  for (const char* name :
       {"", "/", "..", ".", ".bashrc", "-rf", "--out=x.glb", "_a", "顔.png", "a/..", "%2e%2e", "$(x)"}) {
    const std::string safe = SafeFileName(name);
    ASSERT_FALSE(safe.empty()) << name;
    EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(safe.front()))) << safe;
    for (const unsigned char c : safe) EXPECT_TRUE(std::isalnum(c) || c == '.' || c == '_' || c == '-') << safe;
  }
  EXPECT_EQ(SafeFileName(".png"), "file.png");
}

TEST(SafeFileName, KeepsTheEndingOfALongName) {
  EXPECT_EQ(SafeFileName(std::string(500, 'a') + ".jpeg"), std::string(75, 'a') + ".jpeg");
  EXPECT_EQ(SafeFileName(std::string(500, 'a')).size(), 80u);
  EXPECT_EQ(SafeFileName("a." + std::string(500, 'b')).size(), 80u);
}

TEST(Uploads, AreKeptUnderTheirOwnNames) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  const Json json = uploads.Add("../take 1.csv", "1,2");
  EXPECT_EQ(json["id"], "u-0001");
  EXPECT_EQ(json["name"], "take_1.csv");
  const fs::path file = uploads.FileOf("u-0001");
  EXPECT_EQ(file, folder / "u-0001" / "take_1.csv");
  EXPECT_EQ(ReadFile(file), "1,2");
  EXPECT_EQ(uploads.Add("take 1.csv", "3")["id"], "u-0002") << "the same name twice is two files";
  EXPECT_EQ(ReadFile(file), "1,2");
}

TEST(Uploads, HaveKindsByTheirEndingsAndContent) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  const auto kind = [&](const char* name, const char* bytes = "x") {
    return uploads.Add(name, bytes)["kind"].get<std::string>();
  };
  EXPECT_EQ(kind("a.svg"), "drawing");
  EXPECT_EQ(kind("a.OBJ"), "mesh");
  EXPECT_EQ(kind("a.ply"), "mesh");
  EXPECT_EQ(kind("a.csv"), "clip");
  EXPECT_EQ(kind("a.bvh"), "clip");
  EXPECT_EQ(kind("a.json", R"({"version": 1, "sheet": [9, 9], "events": []})"), "session");
  EXPECT_EQ(kind("a.json", R"([{"jawOpen": 1}])"), "clip");
  EXPECT_EQ(kind("a.json", "no json"), "clip");
  EXPECT_EQ(kind("a.exe"), "other");
  EXPECT_EQ(kind("png"), "other");
  EXPECT_EQ(uploads.Add("a.svg", "x")["looks_like"], "drawing");
  EXPECT_TRUE(uploads.Add("a.csv", "x")["looks_like"].is_null());
}

TEST(Uploads, PicturesLookLikePortraitsOrDrawings) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  const render::Image lines = render::RasteriseStrokes(
      {{0, {{60, 40}, {200, 40}, {200, 220}, {60, 220}, {60, 40}}}, {0, {{90, 100}, {110, 100}}}}, 256);
  render::Image painting(200, 160, 3);
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 160; ++column) painting.at(row, column, 1) = uint8_t(row + column / 4);
  const Json drawing = uploads.Add("a.png", render::EncodeImage(lines, render::ImageFormat::kPng));
  EXPECT_EQ(drawing["kind"], "picture");
  EXPECT_EQ(drawing["looks_like"], "drawing");
  const Json portrait = uploads.Add("a.JPG", render::EncodeImage(painting, render::ImageFormat::kJpeg));
  EXPECT_EQ(portrait["looks_like"], "portrait");
  EXPECT_EQ(portrait["size"], (Json{160, 200})) << "width, height";
}

TEST(Uploads, RefuseWhatIsEmptyOrDamaged) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  EXPECT_THROW(uploads.Add("a.png", ""), UsageError);
  EXPECT_EQ(uploads.Add("a.csv", "x")["id"], "u-0001") << "an empty file takes no number";
  EXPECT_THROW(uploads.Add("a.png", "no picture"), Error);
}

TEST(Uploads, LastAsLongAsTheProgram) {
  const testing::TempDir folder;
  { Uploads(folder.path()).Add("a.csv", "x"); }
  const Uploads uploads(folder.path());
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_THROW(uploads.FileOf("u-0001"), NotFound);
}

TEST(Uploads, TheOldestGoWhenThereAreMany) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  for (size_t i = 0; i < Uploads::kMostKept; ++i) uploads.Add("a.csv", "x");
  EXPECT_NO_THROW(uploads.FileOf("u-0001"));
  uploads.Add("a.csv", "x");
  EXPECT_THROW(uploads.FileOf("u-0001"), NotFound);
  EXPECT_NO_THROW(uploads.FileOf("u-0002"));
  for (const char* id : {"", "..", "../u-0002", "u-0002/..", "s-0001", "u-9999"})
    EXPECT_THROW(uploads.FileOf(id), NotFound) << id;
}

TEST(Uploads, ComeFromSeveralThreads) {
  const testing::TempDir folder;
  Uploads uploads(folder.path());
  std::vector<std::future<std::string>> threads;
  for (int i = 0; i < 8; ++i)
    threads.push_back(std::async(std::launch::async, [&uploads, i] {
      const std::string id = uploads.Add("a.csv", std::to_string(i))["id"];
      EXPECT_EQ(ReadFile(uploads.FileOf(id)), std::to_string(i));
      return id;
    }));
  std::set<std::string> ids;
  for (auto& thread : threads) ids.insert(thread.get());
  EXPECT_EQ(ids.size(), 8u);
}

}  // namespace
}  // namespace daumier::studio
