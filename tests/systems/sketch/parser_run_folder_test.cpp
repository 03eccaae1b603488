#include "systems/sketch/parser_run_folder.h"

#include "core/config.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/weights_folder.h"
#include "systems/sketch/parser_options.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

/// A finished run without weights that a network could read.
void WriteParserRun(const std::filesystem::path& folder, const Json& config, const std::string& system) {
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

TEST(ParserRunFolder, HasTheOptionsOfItsNetwork) {
  const testing::TempDir folder;
  ParserTrainingOptions options;
  options.network.resolution = 128;
  options.data = {"/faces", "/sketches"};
  WriteParserRun(folder / "run", ToJson(options), kParserSystem);
  EXPECT_EQ(ReadParserRunFolder(folder / "run").network_options.resolution, 128);
}

TEST(ParserRunFolder, OfAnotherTaskIsRefused) {
  const testing::TempDir folder;
  WriteParserRun(folder / "run", {{"system", "sketch"}}, "sketch");
  testing::ExpectError([&] { ReadParserRunFolder(folder / "run"); }, "sketch");
  testing::ExpectError([&] { ReadParserRunFolder(folder / "nowhere"); }, "nowhere");
}

TEST(ParserNetworkOptionsOf, AreThoseOfARunOrOfShippedWeights) {
  const testing::TempDir folder;
  ParserTrainingOptions options;
  options.network.width = 24;
  WriteParserRun(folder / "run", ToJson(options), kParserSystem);
  EXPECT_EQ(ReadParserNetworkOptions(folder / "run").width, 24);

  MakeDirectory(folder / "parsers");
  Manifest manifest{.kind = kWeightsKind, .verb = "export"};
  options.network.width = 32;
  manifest.details = {
      {"weights_version", kWeightsVersion}, {"system", kParserSystem}, {"network", ToJson(options.network)}};
  for (const char* file : {kWeightsCard, kWeightsNetwork}) {
    WriteFileAtomically(folder / "parsers" / file, file);
    manifest.checksums[file] = Sha256(file);
  }
  WriteManifest(folder / "parsers", manifest);
  EXPECT_EQ(ReadParserNetworkOptions(folder / "parsers").width, 32);
  manifest.details["network"]["width"] = 1;
  WriteManifest(folder / "parsers", manifest);
  testing::ExpectError([&] { ReadParserNetworkOptions(folder / "parsers"); }, "manifest.json");
  manifest.details["system"] = "sketch";
  WriteManifest(folder / "parsers", manifest);
  testing::ExpectError([&] { ReadParserNetworkOptions(folder / "parsers"); }, "weights of 'sketch'");
}

}  // namespace
}  // namespace daumier::sketch
