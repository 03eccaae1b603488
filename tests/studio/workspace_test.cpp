#include "studio/workspace.h"

#include "core/files.h"
#include "studio/api.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using Names = std::vector<std::string>;

TEST(NumberedFolders, AreMadeInTurn) {
  const testing::TempDir place;
  NumberedFolders folders(place / "a" / "sessions", 's');
  EXPECT_TRUE(fs::is_directory(place / "a" / "sessions"));
  EXPECT_EQ(folders.Names(), Names());
  EXPECT_EQ(folders.Add(), "s-0001");
  EXPECT_EQ(folders.Add(), "s-0002");
  EXPECT_EQ(folders.Names(), (Names{"s-0001", "s-0002"}));
  EXPECT_EQ(folders.Of("s-0002"), place / "a" / "sessions" / "s-0002");
  EXPECT_TRUE(fs::is_directory(folders.Of("s-0002")));
}

TEST(NumberedFolders, GiveNoNameTwice) {
  const testing::TempDir place;
  NumberedFolders folders(place.path(), 's');
  folders.Add();
  const std::string removed = folders.Add();
  WriteFileAtomically(folders.Of(removed) / "session.json", "{}");
  folders.Remove(removed);
  EXPECT_FALSE(fs::exists(place / removed));
  EXPECT_FALSE(folders.Has(removed));
  ExpectError([&] { folders.Remove(removed); }, "there is no 's-0002'");
  EXPECT_EQ(folders.Add(), "s-0003");
}

TEST(NumberedFolders, ContinueAfterThoseOfAnEarlierStart) {
  const testing::TempDir place;
  MakeDirectory(place / "s-9999");
  MakeDirectory(place / "s-0002");
  MakeDirectory(place / "f-0500");
  MakeDirectory(place / "mine");
  WriteFileAtomically(place / "s-0003", "a file");
  NumberedFolders folders(place.path(), 's');
  EXPECT_EQ(folders.Add(), "s-10000");
  EXPECT_EQ(folders.Names(), (Names{"s-0002", "s-9999", "s-10000"})) << "ascending by number";
  EXPECT_FALSE(folders.Has("s-0003"));
}

TEST(NumberedFolders, NoNameLeavesTheFolder) {
  const testing::TempDir place;
  MakeDirectory(place / "s-0001");
  MakeDirectory(place / "sessions" / "s-0001" / "s-0002");
  MakeDirectory(place / "sessions" / "f-0001");
  WriteFileAtomically(place / "s-0001" / "precious", "");
  NumberedFolders folders(place / "sessions", 's');
  const std::string long_name = "s-" + std::string(10'000, '0');
  for (const std::string& name : {std::string(),
                                  std::string("."),
                                  std::string(".."),
                                  std::string("../s-0001"),
                                  std::string("s-0001/../../s-0001"),
                                  std::string("s-0001/s-0002"),
                                  std::string("s-0001/"),
                                  std::string("/s-0001"),
                                  (place / "s-0001").string(),
                                  std::string("f-0001"),
                                  std::string("S-0001"),
                                  std::string("s-1"),
                                  std::string("s-001"),
                                  std::string("s-00a1"),
                                  std::string("s-%30001"),
                                  std::string("..%2Fs-0001"),
                                  std::string("s-0001 "),
                                  std::string("s-0001\0", 7),
                                  std::string("s_0001"),
                                  std::string("s--001"),
                                  std::string("s-0003"),
                                  long_name}) {
    EXPECT_FALSE(folders.Has(name)) << name;
    EXPECT_THROW(folders.Of(name), NotFound) << name;
    EXPECT_THROW(folders.Remove(name), NotFound) << name;
  }
  EXPECT_TRUE(fs::exists(place / "s-0001" / "precious"));
  EXPECT_TRUE(folders.Has("s-0001"));
  try {
    folders.Of(long_name);
  } catch (const NotFound& error) {
    EXPECT_LT(std::string(error.what()).size(), 100u) << "a message quotes the beginning";
  }
}

TEST(NumberedFolders, NeedAFolder) {
  const testing::TempDir place;
  WriteFileAtomically(place / "file", "");
  ExpectError([&] { NumberedFolders(place / "file" / "sessions", 's'); }, "file");
}

TEST(KeptName, IsWithoutControlCharactersAndSpaceAround) {
  EXPECT_EQ(KeptName("Ada", "Untitled"), "Ada");
  EXPECT_EQ(KeptName("  A\tda\r\n\x1b[31m\x7f  ", "Untitled"), "Ada[31m");
  EXPECT_EQ(KeptName("Zoë 顔 🙂", "Untitled"), "Zoë 顔 🙂");
  EXPECT_EQ(KeptName("../../etc", "Untitled"), "../../etc") << "it names no file";
  for (const char* name : {"", "   ", "\n\t", " \x01 "}) EXPECT_EQ(KeptName(name, "Untitled"), "Untitled");
}

TEST(KeptName, IsWithoutTheControlCharactersBeyondAscii) {
  EXPECT_EQ(KeptName("a\u0085b\u009Bc", "Untitled"), "abc");
}

TEST(KeptName, IsCutBetweenCharacters) {
  std::string letters, kept;
  for (int i = 0; i < 100; ++i) letters += "é";
  for (int i = 0; i < 80; ++i) kept += "é";
  EXPECT_EQ(KeptName(letters, ""), kept);
  EXPECT_EQ(KeptName(std::string(81, 'a'), ""), std::string(80, 'a'));
  EXPECT_EQ(KeptName("🙂" + std::string(100, 'a'), ""), "🙂" + std::string(79, 'a'));
}

}  // namespace
}  // namespace daumier::studio
