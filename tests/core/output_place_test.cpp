#include "core/output_place.h"

#include "core/error.h"
#include "core/files.h"
#include "core/manifest.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;
using testing::TempDir;

const OutputKind kReport{"report"};
const OutputKind kBuild{"faces", {"building.json"}};

/// A finished folder with a file that its manifest lists.
fs::path WriteOutput(const fs::path& folder, const std::string& kind) {
  MakeDirectory(folder);
  WriteFileAtomically(folder / "table.md", "numbers");
  Manifest manifest{.kind = kind, .verb = "eval"};
  manifest.checksums["table.md"] = Sha256("numbers");
  WriteManifest(folder, manifest);
  return folder;
}

fs::path WriteLetter(const fs::path& file) {
  MakeDirectory(file.parent_path());
  WriteFileAtomically(file, "precious");
  return file;
}

TEST(CheckOutputFolder, TakesNewEmptyAndOwnFolders) {
  const TempDir folder;
  MakeDirectory(folder / "empty");
  WriteOutput(folder / "report", "report");
  for (const char* name : {"new", "new/below", "empty", "empty/", "report", "report/", "empty/../report"})
    EXPECT_NO_THROW(CheckOutputFolder(folder / name, kReport)) << name;
  EXPECT_FALSE(fs::exists(folder / "new")) << "a check writes nothing";
}

TEST(CheckOutputFolder, RefusesFoldersOfOtherKindsAndOfOtherPrograms) {
  const TempDir folder;
  WriteOutput(folder / "run", "run");
  WriteLetter(folder / "home/letter");
  WriteLetter(folder / "web/manifest.json");
  ExpectError([&] { CheckOutputFolder(folder / "run", kReport); },
              "is not empty and holds no earlier report (it is a folder of run)");
  ExpectError([&] { CheckOutputFolder(folder / "home", kReport); }, "(it has 'letter')");
  ExpectError([&] { CheckOutputFolder(folder / "web", kReport); }, "(it has 'manifest.json')");
  EXPECT_THROW(CheckOutputFolder(folder / "web", kReport), UsageError);
}

TEST(CheckOutputFolder, ComparesFilesAndNotTheirNames) {
  const TempDir folder;
  WriteLetter(folder / "home/letter");
  MakeDirectory(folder / "empty");
  fs::create_directory_symlink(folder / "home", folder / "link");
  for (const char* name : {"home/", "home/.", "empty/../home", "link", "link/"})
    ExpectError([&] { CheckOutputFolder(folder / name, kReport); }, "is not empty");
  const fs::path before = fs::current_path();
  fs::current_path(folder / "home");
  ExpectError([] { CheckOutputFolder(".", kReport); }, ". is not empty");
  ExpectError([] { CheckOutputFolder("../home", kReport); }, "is not empty");
  fs::current_path(before);
}

TEST(CheckOutputFolder, RefusesFilesAndPlacesWhereNoFolderCanBe) {
  const TempDir folder;
  WriteLetter(folder / "letter");
  fs::create_symlink(folder / "nowhere", folder / "broken");
  ExpectError([&] { CheckOutputFolder(folder / "letter", kReport); }, "is a file; name a folder");
  ExpectError([&] { CheckOutputFolder(folder / "letter/below/it", kReport); }, "letter is a file");
  ExpectError([&] { CheckOutputFolder(folder / "broken", kReport); }, "is a link to a file that does not exist");
  ExpectError([&] { CheckOutputFolder("", kReport); }, "is empty");
}

TEST(CheckOutputFolder, TakesWhatAStoppedCommandLeftAndNothingMore) {
  const TempDir folder;
  WriteLetter(folder / "stopped/building.json");
  WriteLetter(folder / "stopped/shards/one");
  WriteLetter(folder / "first/building.json.12-3.tmp");
  WriteLetter(folder / "finished/manifest.json.12-3.tmp");
  for (const char* name : {"stopped", "first", "finished"})
    EXPECT_NO_THROW(CheckOutputFolder(folder / name, kBuild)) << name;
  ExpectError([&] { CheckOutputFolder(folder / "stopped", kReport); }, "(it has 'building.json')");
  ExpectError([&] { CheckOutputFolder(folder / "stopped", {"run", {"building.json", "resolved.toml"}}); }, "(it has");
}

TEST(CheckOutputFolder, FilesOfTheDesktopAreNoContent) {
  const TempDir folder;
  for (const char* name : {".DS_Store", "._letter", "Thumbs.db", "desktop.ini"}) WriteLetter(folder.path() / name);
  EXPECT_NO_THROW(CheckOutputFolder(folder.path(), kReport));
  WriteLetter(folder / ".hidden");
  ExpectError([&] { CheckOutputFolder(folder.path(), kReport); }, "(it has '.hidden')");
}

TEST(CheckOutputFolder, RefusesAFolderThatIsOrHoldsAnInput) {
  const TempDir folder;
  const fs::path out = WriteOutput(folder / "report", "report"), inside = WriteLetter(out / "deep/er/face.svg");
  fs::create_symlink(inside, folder / "link.svg");
  MakeDirectory(folder / "elsewhere");
  WriteLetter(folder / "elsewhere/face.svg");
  fs::create_symlink(folder / "elsewhere/face.svg", out / "linked.svg");
  const std::string lies = "lies in the folder to write";
  for (const fs::path& input : {inside, out, out / "", folder / "link.svg", out / "linked.svg", out / "../report/deep"})
    ExpectError([&] { CheckOutputFolder(out, kReport, {folder / "elsewhere", input}); }, lies);
  // The folder may lie in an input, and names that only begin alike are of other folders.
  EXPECT_NO_THROW(CheckOutputFolder(out, kReport, {folder.path(), folder / "rep", folder / "report2/face.svg", ""}));
  EXPECT_NO_THROW(CheckOutputFolder(folder / "new", kReport, {folder / "new/absent.svg"}));
}

TEST(CheckReplacedFolder, RefusesFilesThatTheManifestDoesNotListOrThatHaveChanged) {
  const TempDir folder;
  const fs::path out = WriteOutput(folder / "out", "report");
  WriteLetter(out / ".DS_Store");
  EXPECT_NO_THROW(CheckReplacedFolder(out, "report"));
  EXPECT_NO_THROW(CheckReplacedFolder(folder / "new", "report"));
  WriteFileAtomically(out / "table.md", "my numbers");
  ExpectError([&] { CheckReplacedFolder(out, "report"); }, "table.md has changed since it was written");
  WriteFileAtomically(out / "table.md", "numbers");
  WriteLetter(out / "deep/notes.txt");
  ExpectError([&] { CheckReplacedFolder(out, "report"); }, "deep/notes.txt is not listed in the manifest");
  fs::remove_all(out / "deep");
  fs::remove(out / "table.md");  // Nothing is lost of what is gone.
  EXPECT_NO_THROW(CheckReplacedFolder(out, "report"));
  ExpectError([&] { CheckReplacedFolder(WriteOutput(folder / "run", "run"), "report"); }, "it is a folder of run");
}

TEST(CheckOwnFiles, AreAbsentOrAsTheManifestListsThem) {
  const TempDir folder;
  const fs::path out = WriteOutput(folder / "out", "predictions");
  EXPECT_NO_THROW(CheckOwnFiles(folder / "new", {"face.svg"}));
  EXPECT_NO_THROW(CheckOwnFiles(out, {"table.md", "face.svg"}));
  WriteLetter(out / "face.svg");
  ExpectError([&] { CheckOwnFiles(out, {"table.md", "face.svg"}); }, "face.svg is not listed in the manifest");
  MakeDirectory(folder / "bare");
  WriteLetter(folder / "bare/face.svg");
  ExpectError([&] { CheckOwnFiles(folder / "bare", {"face.svg"}); }, "would be lost");
}

TEST(CheckOwnFiles, AnUnfinishedFileIsTheCommandsOwn) {
  const TempDir folder;
  WriteOutput(folder / "report", "report");
  Manifest manifest = ReadManifest(folder / "report", "report");
  manifest.details[kUnfinishedFiles] = {"plot.png"};
  WriteManifest(folder / "report", manifest);
  WriteLetter(folder / "report/plot.png");
  WriteLetter(folder / "report/letter.txt");
  EXPECT_NO_THROW(CheckOwnFiles(folder / "report", {"table.md", "plot.png"}));
  ExpectError([&] { CheckOwnFiles(folder / "report", {"letter.txt"}); }, "is not listed");
}

TEST(CheckOutputFolder, FindsAtOnceThatNoFolderCanBeMade) {
  if (!fs::is_directory("/proc/self")) GTEST_SKIP() << "no /proc";
  ExpectError([] { CheckOutputFolder("/proc/daumier/out", kReport); }, "cannot write into /proc");
  const TempDir folder;
  EXPECT_NO_THROW(CheckOutputFolder(folder / "new/below/", kReport));
  EXPECT_FALSE(fs::exists(folder / "new")) << "nothing is left of the trial";
}

TEST(CheckOutputFile, ReplacesNoInputAndNothingThatIsToBeKept) {
  const TempDir folder;
  const fs::path mesh = WriteLetter(folder / "head.obj");
  fs::create_symlink(mesh, folder / "link.svg");
  MakeDirectory(folder / "sub");
  for (const ExistingFile existing : {ExistingFile::kKept, ExistingFile::kReplaced}) {
    EXPECT_NO_THROW(CheckOutputFile(folder / "new.svg", existing, {mesh}));
    ExpectError([&] { CheckOutputFile(mesh, existing, {mesh}); }, "is the input and would be overwritten");
    ExpectError([&] { CheckOutputFile(folder / "sub/../link.svg", existing, {mesh}); }, "is the input");
    ExpectError([&] { CheckOutputFile(folder / "sub", existing, {}); }, "is a folder");
    ExpectError([&] { CheckOutputFile(folder / "absent/new.svg", existing, {}); }, "is no folder");
    ExpectError([&] { CheckOutputFile("", existing, {}); }, "no name of a file");
  }
  const fs::path letter = WriteLetter(folder / "letter.svg");
  ExpectError([&] { CheckOutputFile(letter, ExistingFile::kKept, {mesh}); }, "add --force");
  EXPECT_NO_THROW(CheckOutputFile(letter, ExistingFile::kReplaced, {mesh}));
}

}  // namespace
}  // namespace daumier
