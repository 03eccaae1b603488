#include "core/staged_directory.h"

#include "core/files.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

namespace daumier {
namespace {

namespace fs = std::filesystem;
using testing::TempDir;

void WriteExport(const fs::path& directory, const std::string& text, const std::string& kind = "export") {
  Manifest manifest;
  manifest.kind = kind;
  manifest.checksums["text"] = Sha256(text);
  MakeDirectory(directory);
  WriteFileAtomically(directory / "text", text);
  WriteManifest(directory, manifest);
}

int NumFiles(const fs::path& directory) {
  return static_cast<int>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

TEST(StagedDirectory, TakesItsPlaceWholeAndOnlyByCommit) {
  const TempDir folder;
  {
    StagedDirectory staged(folder / "out/", "export");
    WriteExport(staged.path(), "new");
    EXPECT_FALSE(fs::exists(folder / "out"));
    staged.Commit();
  }
  EXPECT_EQ(ReadFile(folder / "out/text"), "new");
  EXPECT_EQ(NumFiles(folder.path()), 1);
}

TEST(StagedDirectory, WithoutCommitLeavesWhatWasThere) {
  const TempDir folder;
  WriteExport(folder / "out", "old");
  { StagedDirectory staged(folder / "out", "export"); }
  EXPECT_EQ(ReadFile(folder / "out/text"), "old");
  EXPECT_EQ(NumFiles(folder.path()), 1);
}

TEST(StagedDirectory, ReplacesAnEarlierOneAndWhatAKillLeft) {
  const TempDir folder;
  WriteExport(folder / "out", "old");
  WriteExport(folder / ".out.daumier-partial", "half");
  StagedDirectory staged(folder / "out", "export");
  EXPECT_EQ(NumFiles(staged.path()), 0);
  WriteExport(staged.path(), "new");
  staged.Commit();
  EXPECT_EQ(ReadFile(folder / "out/text"), "new");
  EXPECT_EQ(NumFiles(folder.path()), 1);
}

TEST(StagedDirectory, FoldersOfSimilarNamesStay) {
  const TempDir folder;
  WriteExport(folder / "out", "old");
  for (const char* name : {".out.partial", ".out.old"}) WriteExport(folder / name, "precious");
  StagedDirectory staged(folder / "out", "export");
  WriteExport(staged.path(), "new");
  staged.Commit();
  EXPECT_EQ(NumFiles(folder.path()), 3);
  EXPECT_EQ(ReadFile(folder / ".out.old/text"), "precious");
}

TEST(StagedDirectory, OneWriterAtATimeAndTheLastOneStays) {
  const TempDir folder;
  std::vector<std::jthread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&, i] {
      StagedDirectory staged(folder / "out", "export");
      WriteExport(staged.path(), std::to_string(i));
      staged.Commit();
    });
  writers.clear();
  EXPECT_NO_THROW(VerifyChecksums(folder / "out", ReadManifest(folder / "out", "export")));
  EXPECT_EQ(NumFiles(folder.path()), 1);
}

TEST(StagedDirectory, ALinkStaysAndItsFolderIsReplaced) {
  const TempDir folder;
  WriteExport(folder / "disk/out", "old");
  fs::create_directory_symlink(folder / "disk/out", folder / "link");
  StagedDirectory staged(folder / "link/", "export");
  WriteExport(staged.path(), "new");
  staged.Commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(ReadFile(folder / "disk/out/text"), "new");
}

TEST(StagedDirectory, RefusesFilesOfOthersInAnEarlierOne) {
  const TempDir folder;
  WriteExport(folder / "out", "old");
  WriteFileAtomically(folder / "out/letter", "precious");
  testing::ExpectError([&] { StagedDirectory(folder / "out", "export"); }, "letter is not listed in the manifest");
  EXPECT_EQ(ReadFile(folder / "out/letter"), "precious");
}

TEST(StagedDirectory, RefusesForeignFoldersAndFiles) {
  const TempDir folder;
  WriteExport(folder / "run", "precious", "run");
  MakeDirectory(folder / "home");
  WriteFileAtomically(folder / "home/letter", "precious");
  WriteFileAtomically(folder / "file", "precious");
  for (const char* name : {"run", "home"}) {
    testing::ExpectError([&] { StagedDirectory(folder / name, "export"); }, "is not empty and holds no earlier export");
  }
  testing::ExpectError([&] { StagedDirectory(folder / "file", "export"); }, "is a file");
  EXPECT_EQ(NumFiles(folder.path()), 3);
}

}  // namespace
}  // namespace daumier
