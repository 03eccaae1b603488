#include "core/weights_folder.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

namespace fs = std::filesystem;
using testing::ExpectError;

Manifest WeightsManifest() {
  Manifest manifest{.kind = kWeightsKind, .verb = "export"};
  manifest.details = {{"weights_version", kWeightsVersion}, {"system", "landmarks"}};
  return manifest;
}

class WeightsFolderTest : public ::testing::Test {
 protected:
  void SetUp() override { Write(WeightsManifest(), "landmarks"); }

  void Write(Manifest manifest, const std::string& name) {
    MakeDirectory(folder_ / name);
    for (const char* file : {kWeightsCard, kWeightsNetwork}) {
      WriteFileAtomically(folder_ / name / file, file);
      manifest.checksums[file] = Sha256(file);
    }
    WriteManifest(folder_ / name, manifest);
  }

  const testing::TempDir folder_;
};

TEST_F(WeightsFolderTest, AreReadWithTheirManifest) {
  EXPECT_TRUE(IsWeightsFolder(folder_ / "landmarks"));
  const Manifest manifest = ReadWeights(folder_ / "landmarks", "landmarks", {kWeightsNetwork});
  EXPECT_EQ(manifest.details, WeightsManifest().details);
  EXPECT_EQ(manifest.checksums.size(), 2U);
}

TEST_F(WeightsFolderTest, OtherFoldersAreNone) {
  EXPECT_FALSE(IsWeightsFolder(folder_.path()));
  EXPECT_FALSE(IsWeightsFolder(folder_ / "nowhere"));
  EXPECT_FALSE(IsWeightsFolder(folder_ / "landmarks" / kWeightsCard));
  WriteManifest(folder_.path(), {.kind = "run", .verb = "train"});
  EXPECT_FALSE(IsWeightsFolder(folder_.path()));
  ExpectError([&] { ReadWeights(folder_.path()); }, "this is a run folder, expected a folder of weights");
  ExpectError([&] { ReadWeights(folder_ / "nowhere"); }, "nowhere does not exist (expected a folder of weights)");
  WriteFileAtomically(folder_ / "manifest.json", "{");
  EXPECT_FALSE(IsWeightsFolder(folder_.path()));
  ExpectError([&] { ReadWeights(folder_.path()); }, "manifest.json");
}

TEST_F(WeightsFolderTest, NumbersWithoutAReadableManifestAreDamaged) {
  const fs::path folder = folder_ / "landmarks";
  for (const fs::path& sound : {folder, folder_.path(), folder_ / "nowhere", folder / kWeightsCard})
    EXPECT_NO_THROW(CheckNotDamaged(sound));
  WriteFileAtomically(folder / "manifest.json", "{\"kind\": \"wei");
  ExpectError([&] { CheckNotDamaged(folder); }, "landmarks: weights whose manifest.json is missing or malformed");
  for (const char* other : {"{}", "[1]", R"({"kind": "run"})"}) {
    WriteFileAtomically(folder / "manifest.json", other);
    ExpectError([&] { CheckNotDamaged(folder); }, "is missing or malformed");
  }
  fs::remove(folder / "manifest.json");
  ExpectError([&] { CheckNotDamaged(folder); }, "Restore the folder from the release");
}

TEST_F(WeightsFolderTest, OfAnotherTaskAreRefused) {
  ExpectError([&] { ReadWeights(folder_ / "landmarks", "portrait"); },
              "weights of 'landmarks' (expected of 'portrait')");
  Manifest manifest = WeightsManifest();
  manifest.details.erase("system");
  Write(manifest, "landmarks");
  ExpectError([&] { ReadWeights(folder_ / "landmarks"); }, "details.system is missing");
}

TEST_F(WeightsFolderTest, OfAnotherVersionAreRefused) {
  for (const Json& version : {Json(2), Json(0), Json("1"), Json()}) {
    Manifest manifest = WeightsManifest();
    manifest.details["weights_version"] = version;
    Write(manifest, "landmarks");
    ExpectError([&] { ReadWeights(folder_ / "landmarks"); },
                "weights_version is " + version.dump() + ", this program reads 1");
  }
}

TEST_F(WeightsFolderTest, AChangedOrMissingFileIsNamedWithTheRepair) {
  for (const char* file : {kWeightsCard, kWeightsNetwork}) {
    Write(WeightsManifest(), "landmarks");
    std::string bytes = ReadFile(folder_ / "landmarks" / file);
    bytes[bytes.size() / 2] ^= 1;
    WriteFileAtomically(folder_ / "landmarks" / file, bytes);
    ExpectError([&] { ReadWeights(folder_ / "landmarks"); }, std::string(file) + " has changed: its SHA-256 is ");
    ExpectError([&] { ReadWeights(folder_ / "landmarks"); }, "Restore the folder from the release");
    fs::remove(folder_ / "landmarks" / file);
    ExpectError([&] { ReadWeights(folder_ / "landmarks"); }, std::string(file) + " is missing");
  }
}

TEST_F(WeightsFolderTest, FilesThatAreNotListedAreNotTrusted) {
  ExpectError([&] { ReadWeights(folder_ / "landmarks", "", {"identity.safetensors"}); },
              "manifest.json does not list identity.safetensors");
  Manifest manifest = WeightsManifest();
  WriteManifest(folder_ / "landmarks", manifest);
  ExpectError([&] { ReadWeights(folder_ / "landmarks"); }, "does not list README.md");
}

TEST_F(WeightsFolderTest, NeededWeightsAreNextToThemAndOfTheSameRelease) {
  Write(WeightsManifest(), "face-ict");
  Manifest manifest = WeightsManifest();
  manifest.details["needs"] = {{"face-ict", DataHash(folder_ / "face-ict")}};
  Write(manifest, "portrait");
  for (const fs::path& path : {folder_ / "portrait", folder_ / "portrait/", folder_ / "face-ict/../portrait"})
    EXPECT_EQ(NeededWeights(path, manifest, "face-ict"), folder_ / "face-ict") << path;
  ExpectError([&] { NeededWeights(folder_ / "portrait", manifest, "face-makehuman"); },
              "does not list 'face-makehuman' in details.needs");
  Manifest other = WeightsManifest();
  other.seed = 2;
  Write(other, "face-ict");
  ExpectError([&] { NeededWeights(folder_ / "portrait", manifest, "face-ict"); },
              "needs other weights than those of " + (folder_ / "face-ict").string());
  fs::remove_all(folder_ / "face-ict");
  ExpectError([&] { NeededWeights(folder_ / "portrait", manifest, "face-ict"); }, "which are missing");
}

}  // namespace
}  // namespace daumier
