#include "systems/portrait/landmark_run_folder.h"

#include "core/config.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "systems/portrait/landmark_options.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

/// A finished run without weights that a network could read.
void WriteRun(const std::filesystem::path& folder, const Json& config, const std::string& system) {
  MakeDirectory(folder / "best");
  WriteFileAtomically(folder / kBestFile, "weights");
  WriteFileAtomically(folder / "resolved.toml", ToToml(config));
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = config;
  manifest.config.erase("data");
  manifest.counts = {{"best_epoch", 1}};
  manifest.details = {{"system", system}};
  manifest.checksums[kBestFile] = Sha256("weights");
  WriteManifest(folder, manifest);
}

TEST(LandmarkRunFolder, HasTheOptionsOfItsNetwork) {
  const testing::TempDir folder;
  LandmarkTrainingOptions options;
  options.network.resolution = 96;
  options.data.portraits = "/data";
  WriteRun(folder / "run", ToJson(options), kLandmarkSystem);
  EXPECT_EQ(ReadLandmarkRunFolder(folder / "run").network_options.resolution, 96);
}

TEST(LandmarkRunFolder, OfAnotherTaskIsRefused) {
  const testing::TempDir folder;
  WriteRun(folder / "run", {{"system", "sketch"}}, "sketch");
  testing::ExpectError([&] { ReadLandmarkRunFolder(folder / "run"); }, "sketch");
  testing::ExpectError([&] { ReadLandmarkRunFolder(folder / "nowhere"); }, "nowhere");
}

TEST(LandmarkNetworkOptionsOf, AreThoseOfARunOrOfShippedWeights) {
  const testing::TempDir folder;
  LandmarkTrainingOptions options;
  options.network.width = 24;
  WriteRun(folder / "run", ToJson(options), kLandmarkSystem);
  EXPECT_EQ(ReadLandmarkNetworkOptions(folder / "run").width, 24);

  MakeDirectory(folder / "landmarks");
  Manifest manifest{.kind = kWeightsKind, .verb = "export"};
  options.network.width = 32;
  manifest.details = {
      {"weights_version", kWeightsVersion}, {"system", kLandmarkSystem}, {"network", ToJson(options.network)}};
  for (const char* file : {kWeightsCard, kWeightsNetwork}) {
    WriteFileAtomically(folder / "landmarks" / file, file);
    manifest.checksums[file] = Sha256(file);
  }
  WriteManifest(folder / "landmarks", manifest);
  EXPECT_EQ(ReadLandmarkNetworkOptions(folder / "landmarks").width, 32);
  manifest.details["network"]["width"] = 1;
  WriteManifest(folder / "landmarks", manifest);
  testing::ExpectError([&] { ReadLandmarkNetworkOptions(folder / "landmarks"); }, "manifest.json");
  manifest.details["system"] = "portrait";
  WriteManifest(folder / "landmarks", manifest);
  testing::ExpectError([&] { ReadLandmarkNetworkOptions(folder / "landmarks"); }, "weights of 'portrait'");
}

}  // namespace
}  // namespace daumier::portrait
