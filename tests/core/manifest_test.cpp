#include "core/manifest.h"

#include "core/error.h"
#include "core/files.h"
#include "core/random.h"
#include "tests/support/corruption.h"
#include "tests/support/temp_dir.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace daumier {
namespace {

using ::testing::HasSubstr;
using testing::TempDir;

Manifest Example() {
  Manifest manifest;
  manifest.kind = "faces";
  manifest.verb = "dataset faces";
  manifest.config = {{"seed", 3}, {"exaggeration", {{"gamma", 0.2}}}};
  manifest.seed = 18446744073709551615u;
  manifest.sources = {{{"name", "makehuman"}, {"licence", "CC0"}}};
  manifest.counts = {{"faces", 24}};
  manifest.details = {{"splits", {{"train", {0, 1}}}}};
  manifest.checksums = {{"b.safetensors", Sha256("b")}, {"a/a.safetensors", Sha256("a")}};
  return manifest;
}

std::string ReadFailure(const std::filesystem::path& directory, const std::string& kind = "") {
  try {
    ReadManifest(directory, kind);
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr(directory.string()));
    return error.what();
  }
  return "no error";
}

void Replace(const std::filesystem::path& directory, const std::string& from, const std::string& to) {
  std::string text = ReadFile(directory / "manifest.json");
  const size_t position = text.find(from);
  ASSERT_NE(position, std::string::npos);
  WriteFileAtomically(directory / "manifest.json", text.replace(position, from.size(), to));
}

TEST(Manifest, ReadUndoesWrite) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  const Manifest read = ReadManifest(dir.path(), "faces");
  EXPECT_EQ(read.kind, "faces");
  EXPECT_EQ(read.verb, "dataset faces");
  EXPECT_EQ(read.config, Example().config);
  EXPECT_EQ(read.seed, Example().seed);
  EXPECT_EQ(read.sources, Example().sources);
  EXPECT_EQ(read.counts, Example().counts);
  EXPECT_EQ(read.details, Example().details);
  EXPECT_EQ(read.checksums, Example().checksums);
}

TEST(Manifest, EqualWorkGivesEqualBytes) {
  const TempDir a, b;
  WriteManifest(a.path(), Example());
  WriteManifest(b.path(), Example());
  EXPECT_EQ(ReadFile(a / "manifest.json"), ReadFile(b / "manifest.json"));
  EXPECT_EQ(DataHash(a.path()), DataHash(b.path()));
  EXPECT_EQ(DataHash(a.path()), Sha256OfFile(a / "manifest.json"));
}

TEST(Manifest, MissingFileIsNamedWithTheRepair) {
  const TempDir dir;
  const std::string folder = dir.path().string(), absent = (dir / "absent").string();
  EXPECT_EQ(ReadFailure(dir.path(), "sketches"),
            folder +
                " is not a folder of sketches (manifest.json is missing). Make one with `daumier dataset sketches "
                "--out " +
                folder + "`, or name another folder");
  EXPECT_EQ(ReadFailure(absent, "run"), absent +
                                            " does not exist (expected a run folder). Make one with `daumier "
                                            "train CONFIG --out " +
                                            absent + "`, or name another folder");
  EXPECT_EQ(ReadFailure(absent, ""),
            absent + " does not exist (expected a folder that daumier wrote). Name another folder");
  EXPECT_THROW(DataHash(absent), Error);
  WriteFileAtomically(dir / kBuildJournal, "{}");
  EXPECT_THAT(ReadFailure(dir.path(), "faces"), HasSubstr("is not finished"));
}

TEST(Manifest, AnotherKindIsRefused) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  EXPECT_THAT(ReadFailure(dir.path(), "sketches"),
              AllOf(HasSubstr("this is a folder of faces, expected a folder of sketches. Make one with"),
                    HasSubstr("or name another folder")));
  EXPECT_EQ(ReadFailure(dir.path(), ""), "no error");
}

TEST(Manifest, NewerVersionIsRefusedAndSaysSo) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  Replace(dir.path(), "\"format_version\": 1", "\"format_version\": 2");
  EXPECT_THAT(ReadFailure(dir.path()), HasSubstr("format version 2 is newer than this program, which reads version 1"));
  Replace(dir.path(), "\"format_version\": 2", "\"format_version\": 0");
  EXPECT_THAT(ReadFailure(dir.path()), HasSubstr("format version 0 is unknown"));
}

TEST(Manifest, MissingAndMistypedFieldsAreNamed) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  Replace(dir.path(), "\"kind\"", "\"kinds\"");
  EXPECT_THAT(ReadFailure(dir.path()), HasSubstr("'kind' is missing"));
  Replace(dir.path(), "\"kinds\": \"faces\"", "\"kind\": 3");
  EXPECT_THAT(ReadFailure(dir.path()), HasSubstr("'kind' has the wrong type"));
}

TEST(Manifest, EveryTruncationIsRefused) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  const std::string bytes = ReadFile(dir / "manifest.json");
  const int num_refused =
      testing::CountRefusedTruncations(dir / "manifest.json", bytes, [&] { ReadManifest(dir.path(), ""); });
  EXPECT_EQ(num_refused, static_cast<int>(bytes.size()) - 1);  // The last byte is a newline after the whole object.
}

TEST(Manifest, SurvivesFlippedBytes) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  Rng rng(1);
  const int num_refused = testing::CountRefusedFlips(dir / "manifest.json", ReadFile(dir / "manifest.json"), 300, rng,
                                                     [&] { ReadManifest(dir.path(), "faces"); });
  EXPECT_GT(num_refused, 50);
}

TEST(Manifest, FilesOutsideOfTheFolderAreRefused) {
  const TempDir dir;
  WriteManifest(dir.path(), Example());
  Replace(dir.path(), "\"b.safetensors\"", "\"a/../../b\"");
  EXPECT_THAT(ReadFailure(dir.path()), HasSubstr("lies outside of the folder"));
}

TEST(Manifest, VerifyAcceptsWhatIsAsItWas) {
  const TempDir dir;
  MakeDirectory(dir / "a");
  WriteFileAtomically(dir / "a/a.safetensors", "a");
  WriteFileAtomically(dir / "b.safetensors", "b");
  EXPECT_NO_THROW(VerifyChecksums(dir.path(), Example()));
}

TEST(Manifest, VerifyNamesTheFileThatIsMissingOrDiffersAndTheRemedy) {
  const TempDir dir;
  MakeDirectory(dir / "a");
  WriteFileAtomically(dir / "a/a.safetensors", "a");
  const auto failure = [&] {
    try {
      VerifyChecksums(dir.path(), Example());
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(failure(),
            (dir / "b.safetensors").string() +
                " is missing though manifest.json lists it; delete the folder and run `daumier dataset faces` again");
  WriteFileAtomically(dir / "b.safetensors", "c");
  EXPECT_EQ(failure(), (dir / "b.safetensors").string() +
                           " is corrupt: its checksum differs from that in manifest.json; delete the folder and run "
                           "`daumier dataset faces` again");
}

}  // namespace
}  // namespace daumier
