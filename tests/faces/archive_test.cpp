#include "faces/archive.h"

#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>

namespace daumier::faces {
namespace {

using testing::ExpectError;
using testing::TempDir;

std::map<std::string, std::string> ReadAll(const std::filesystem::path& path) {
  std::map<std::string, std::string> files;
  ForEachFile(
      path, [](const std::string& name) { return name.ends_with(".txt"); },
      [&](const std::string& name, std::string_view content) { files[name] = content; });
  return files;
}

class ArchiveTest : public ::testing::Test {
 protected:
  void SetUp() override {
    MakeDirectory(directory_ / "content/below");
    WriteFileAtomically(directory_ / "content/a.txt", "first");
    WriteFileAtomically(directory_ / "content/below/b.txt", std::string(100'000, 'b'));
    WriteFileAtomically(directory_ / "content/passed_over.bin", "x");
    WriteFileAtomically(directory_ / "content/empty.txt", "");
  }
  std::filesystem::path Pack(const std::string& name, const std::string& flags) {
    const std::string command = fmt::format("tar -C '{}' {} -cf '{}' a.txt below passed_over.bin empty.txt",
                                            (directory_ / "content").string(), flags, (directory_ / name).string());
    EXPECT_EQ(std::system(command.c_str()), 0);
    return directory_ / name;
  }

  TempDir directory_;
};

TEST_F(ArchiveTest, FolderAndArchivesGiveTheSameFiles) {
  const auto expected = ReadAll(directory_ / "content");
  EXPECT_EQ(expected.size(), 3u);
  EXPECT_EQ(expected.at("a.txt"), "first");
  EXPECT_EQ(expected.at("below/b.txt").size(), 100'000u);
  EXPECT_EQ(ReadAll(Pack("plain.tar", "")), expected);
  EXPECT_EQ(ReadAll(Pack("packed.tar.gz", "-z")), expected);
  EXPECT_EQ(ReadAll(Pack("packed.tar.xz", "-J")), expected);
}

TEST_F(ArchiveTest, FilesOfMacOsAreLeftOut) {
  const auto expected = ReadAll(directory_ / "content");
  MakeDirectory(directory_ / "content/below/__MACOSX");
  for (const char* path : {"below/._b.txt", "below/__MACOSX/a.txt", "below/.hidden.txt"})
    WriteFileAtomically(directory_ / "content" / path, "resource");
  EXPECT_EQ(ReadAll(directory_ / "content"), expected);
  EXPECT_EQ(ReadAll(Pack("mac.tar", "")), expected);
}

TEST_F(ArchiveTest, TruncatedArchivesAreRefusedByName) {
  for (const char* flags : {"", "-z", "-J"}) {
    const std::string bytes = ReadFile(Pack("whole.tar", flags));
    for (const double share : {0.3, 0.6}) {
      WriteFileAtomically(directory_ / "cut.tar", bytes.substr(0, static_cast<size_t>(share * bytes.size())));
      ExpectError([&] { ReadAll(directory_ / "cut.tar"); }, "cut.tar");
    }
  }
}

TEST_F(ArchiveTest, FlippedByteInACompressedArchiveIsRefused) {
  std::string bytes = ReadFile(Pack("whole.tar.xz", "-J"));
  bytes[bytes.size() / 2] ^= 0x20;
  WriteFileAtomically(directory_ / "bad.tar.xz", bytes);
  ExpectError([&] { ReadAll(directory_ / "bad.tar.xz"); }, "bad.tar.xz");
}

TEST_F(ArchiveTest, WhatIsMissingOrNoArchiveIsRefused) {
  ExpectError([&] { ReadAll(directory_ / "nowhere"); }, "does not exist");
  WriteFileAtomically(directory_ / "note.tar", "this is no archive, though it is called one");
  ExpectError([&] { ReadAll(directory_ / "note.tar"); }, "cannot be read as a tar or zip archive");
}

TEST_F(ArchiveTest, AnEntryWithoutAReadableNameIsAnError) {
  // A zip whose name is marked as UTF-8 and is not: one stored byte, "x".
  const std::string zip("PK\3\4\x14\0\0\x08\0\0\0\0\0\0\x83\x16\xdc\x8c\1\0\0\0\1\0\0\0\6\0\0\0\xff\xfe.txtx", 37);
  WriteFileAtomically(directory_ / "name.zip", zip);
  ExpectError([&] { ReadAll(directory_ / "name.zip"); }, "the name of an entry is not readable");
}

}  // namespace
}  // namespace daumier::faces
