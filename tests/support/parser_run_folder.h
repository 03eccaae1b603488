#pragma once
#include "core/config.h"
#include "core/files.h"
#include "core/manifest.h"
#include "core/run_manifest.h"
#include "systems/sketch/parser_options.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/train/parser_network.h"
#include "tensor/module_state.h"

#include <torch/utils.h>

#include <filesystem>

namespace daumier::testing {

/// Writes the run folder of a small, untrained parser of drawings: what it finds is no face, but the same each time.
inline void WriteParserRun(const std::filesystem::path& directory) {
  sketch::ParserTrainingOptions options;
  options.data = {"/faces", "/sketches"};
  options.network = {.resolution = 64, .width = 16, .point_width = 16};
  torch::manual_seed(5);
  const models::HeatMapUnet network = sketch::MakeParserNetwork(options.network);
  MakeDirectory(directory / "best");
  WriteFileAtomically(ResolvedConfig(directory), ToToml(ToJson(options)));
  Manifest manifest{.kind = "run", .verb = "train"};
  manifest.config = ToJson(options);
  manifest.config.erase("data");
  manifest.seed = 5;
  manifest.counts = {{"best_epoch", 1}};
  manifest.details = {{"system", sketch::kParserSystem}};
  tensor::SaveModule(BestWeights(directory), *network);
  manifest.checksums[kBestFile] = Sha256OfFile(BestWeights(directory));
  WriteManifest(directory, manifest);
}

}  // namespace daumier::testing
