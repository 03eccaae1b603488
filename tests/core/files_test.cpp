#include "core/files.h"

#include "core/error.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <thread>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;
using testing::TempDir;

std::string FailureOfCall(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

size_t NumEntries(const fs::path& folder) {
  return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(Files, ReadUndoesWrite) {
  const TempDir dir;
  const std::string bytes("a\0b\n\xff", 5);
  WriteFileAtomically(dir / "file", bytes);
  EXPECT_EQ(ReadFile(dir / "file"), bytes);
  WriteFileAtomically(dir / "file", "");
  EXPECT_EQ(ReadFile(dir / "file"), "");
}

TEST(Files, ReadOfManyPiecesIsWhole) {
  const TempDir dir;
  std::string bytes(3'000'001, 'x');
  bytes[2'500'000] = 'y';
  WriteFileAtomically(dir / "file", bytes);
  EXPECT_EQ(ReadFile(dir / "file"), bytes);
  EXPECT_EQ(Sha256OfFile(dir / "file"), Sha256(bytes));
}

TEST(Files, ReadNamesFileAndCause) {
  const TempDir dir;
  const std::string path = (dir / "absent").string();
  EXPECT_EQ(FailureOfCall([&] { ReadFile(path); }), "cannot read " + path + ": No such file or directory");
  EXPECT_EQ(FailureOfCall([&] { Sha256OfFile(path); }), "cannot read " + path + ": No such file or directory");
  EXPECT_EQ(FailureOfCall([&] { ReadFile(dir.path()); }), "cannot read " + dir.path().string() + ": not a file");
}

TEST(Files, WriteReplacesTheOldFileAndLeavesNothingElse) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "old and longer");
  WriteFileAtomically(dir / "file", "new");
  EXPECT_EQ(ReadFile(dir / "file"), "new");
  EXPECT_EQ(NumEntries(dir.path()), 1u);
}

TEST(Files, OpenReaderKeepsTheOldFile) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "old");
  const MappedFile mapped(dir / "file");
  WriteFileAtomically(dir / "file", "new");
  EXPECT_EQ(mapped.bytes(), "old");
}

TEST(Files, WriteIfChangedTouchesNoFileThatHasTheBytes) {
  const testing::TempDir dir;
  WriteFileIfChanged(dir / "a", "one");
  EXPECT_EQ(ReadFile(dir / "a"), "one");
  const std::filesystem::file_time_type long_ago{};
  std::filesystem::last_write_time(dir / "a", long_ago);
  WriteFileIfChanged(dir / "a", "one");
  EXPECT_EQ(std::filesystem::last_write_time(dir / "a"), long_ago);
  for (const char* other : {"two", "", "longer"}) {
    WriteFileIfChanged(dir / "a", other);
    EXPECT_EQ(ReadFile(dir / "a"), other);
  }
}

TEST(Files, WriteIntoAnAbsentFolderNamesFileAndCause) {
  const TempDir dir;
  const std::string path = (dir / "absent/file").string();
  EXPECT_EQ(FailureOfCall([&] { WriteFileAtomically(path, "x"); }),
            "cannot write " + path + ": No such file or directory");
}

TEST(Files, WriteToANameThatIsTooLongNamesTheRepair) {
  const TempDir dir;
  const std::string path = (dir / std::string(300, 'n')).string();
  EXPECT_EQ(FailureOfCall([&] { WriteFileAtomically(path, "x"); }),
            "cannot write " + path + ": the name is too long; choose a shorter one");
}

TEST(Files, WriteOntoAFolderLeavesNothingBehind) {
  const TempDir dir;
  MakeDirectory(dir / "taken/inside");
  EXPECT_THROW(WriteFileAtomically(dir / "taken", "x"), Error);
  EXPECT_EQ(NumEntries(dir.path()), 1u);
}

TEST(Files, AFileThatIsTooLargeIsReportedAndLeavesTheOldOne) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "old");
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 2000, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = FailureOfCall([&] { WriteFileAtomically(dir / "file", std::string(200'000, 'x')); });
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message, "cannot write " + (dir / "file").string() +
                         ": the file would be larger than the limit; raise it (ulimit -f)");
  EXPECT_EQ(ReadFile(dir / "file"), "old");
  EXPECT_EQ(NumEntries(dir.path()), 1u);
}

TEST(Files, WritingTouchesNoFileOfAnotherName) {
  const TempDir dir;
  WriteFileAtomically(dir / "victim", "untouched");
  WriteFileAtomically(dir / "b.tmp", "mine");
  fs::create_symlink(dir / "victim", dir / "a.tmp");
  WriteFileAtomically(dir / "a", "new");
  WriteFileAtomically(dir / "b", "new");
  EXPECT_EQ(ReadFile(dir / "victim"), "untouched");
  EXPECT_EQ(ReadFile(dir / "b.tmp"), "mine");
  EXPECT_FALSE(fs::is_symlink(dir / "a"));
  EXPECT_TRUE(fs::is_symlink(dir / "a.tmp"));
}

TEST(Files, ManyWritersOfOneFileLeaveAWholeOne) {
  const TempDir dir;
  std::vector<std::thread> writers;
  for (int w = 0; w < 8; ++w)
    writers.emplace_back([&dir, w] {
      for (int i = 0; i < 20; ++i) WriteFileAtomically(dir / "file", std::string(100'000, char('a' + w)));
    });
  for (int i = 0; i < 50; ++i) {
    if (!fs::exists(dir / "file")) continue;
    const std::string seen = ReadFile(dir / "file");
    EXPECT_EQ(seen, std::string(100'000, seen.at(0)));
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(ReadFile(dir / "file").size(), 100'000u);
  EXPECT_EQ(NumEntries(dir.path()), 1u);
}

TEST(Files, TemporaryNamesBelongToTheirFile) {
  for (const char* name : {"file.tmp", "file.12-3.tmp"}) EXPECT_TRUE(IsTemporaryNameOf(name, "file")) << name;
  for (const char* name : {"file", "filed.tmp", "other.12-3.tmp", "file.12-3", ".tmp"})
    EXPECT_FALSE(IsTemporaryNameOf(name, "file")) << name;
}

TEST(Files, FullTmpfsIsReportedAndLeavesTheOldFile) {
  const TempDir dir;
  if (mount("tmpfs", dir.path().c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting a tmpfs needs root";
  WriteFileAtomically(dir / "file", "old");
  const std::string message = FailureOfCall([&] { WriteFileAtomically(dir / "file", std::string(200'000, 'x')); });
  const size_t num_entries = NumEntries(dir.path());
  const std::string content = ReadFile(dir / "file");
  umount(dir.path().c_str());
  EXPECT_THAT(message, ::testing::HasSubstr("no space left on the disk"));
  EXPECT_EQ(content, "old");
  EXPECT_EQ(num_entries, 1u);
}

TEST(Files, Sha256HasTheStandardsValues) {
  // FIPS 180-4, appendix B.1, and the empty text.
  EXPECT_EQ(Sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Files, MakeDirectoryMakesParentsAndMayRepeat) {
  const TempDir dir;
  MakeDirectory(dir / "a/b/c");
  MakeDirectory(dir / "a/b/c");
  EXPECT_TRUE(fs::is_directory(dir / "a/b/c"));
}

TEST(Files, MakeDirectoryNamesPathAndCause) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "x");
  EXPECT_THAT(FailureOfCall([&] { MakeDirectory(dir / "file"); }), ::testing::HasSubstr((dir / "file").string()));
  EXPECT_EQ(FailureOfCall([&] { MakeDirectory(dir / "file/sub"); }),
            "cannot create folder " + (dir / "file/sub").string() + ": Not a directory");
}

TEST(MappedFile, ShowsTheWholeFile) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "hello");
  const MappedFile file(dir / "file");
  EXPECT_EQ(file.bytes(), "hello");
}

TEST(MappedFile, MayBeEmpty) {
  const TempDir dir;
  WriteFileAtomically(dir / "file", "");
  EXPECT_TRUE(MappedFile(dir / "file").bytes().empty());
}

TEST(MappedFile, MovesItsMapping) {
  const TempDir dir;
  WriteFileAtomically(dir / "a", "aaa");
  WriteFileAtomically(dir / "b", "bbb");
  MappedFile a(dir / "a"), b(dir / "b");
  a = std::move(b);
  EXPECT_EQ(a.bytes(), "bbb");
  const MappedFile c = std::move(a);
  EXPECT_EQ(c.bytes(), "bbb");
}

TEST(MappedFile, AbsentFileThrows) {
  const TempDir dir;
  EXPECT_THROW(MappedFile(dir / "absent"), Error);
  EXPECT_THROW(MappedFile{dir.path()}, Error);
}

TEST(IsSystemFile, IsWhatMacOsAddsToFolders) {
  for (const char* path : {"._a.obj", ".DS_Store", "bob/._1.obj", "__MACOSX/a.obj", "a/__MACOSX/b/c.obj", ".git/a.obj"})
    EXPECT_TRUE(IsSystemFile(path)) << path;
  for (const char* path : {"a.obj", "./a.obj", "../a.obj", "a.b/c", "_a.obj", "MACOSX/a.obj", ""})
    EXPECT_FALSE(IsSystemFile(path)) << path;
}

TEST(WithoutFolder, LeavesNamesRelativeToIt) {
  EXPECT_EQ(WithoutFolder("/a/b/c.png: bad, as /a/b/d/e.png", "/a/b"), "c.png: bad, as d/e.png");
  EXPECT_EQ(WithoutFolder("/a/b/c.png: bad", "/a/b/"), "c.png: bad");
  EXPECT_EQ(WithoutFolder("/a/bc.png: bad", "/a/b"), "/a/bc.png: bad");
  EXPECT_EQ(WithoutFolder("c.png: bad", ""), "c.png: bad");
}

}  // namespace
}  // namespace daumier
