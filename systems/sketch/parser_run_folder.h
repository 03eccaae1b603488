#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "systems/sketch/parser_network_options.h"

#include <filesystem>

namespace daumier::sketch {

/// `system` in the config and the manifest of a run that parses drawings.
inline constexpr const char* kParserSystem = "drawing_parser";

/// All of a run folder but the weights:
///   manifest.json (kind "run", details.split = SplitToJson),
///   resolved.toml (tables `network` = ParserNetworkOptions, `drawings` = StyledReading; the data paths),
///   best/{model.safetensors,model.onnx}, checkpoints/latest/
struct ParserRunFolder {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  ParserNetworkOptions network_options;
};

/// @throws Error as ReadFinishedRun, and naming the file if one is malformed.
ParserRunFolder ReadParserRunFolder(const std::filesystem::path& directory);

/// Of a finished run, or of shipped weights (details.network). @throws Error as ReadParserRunFolder and ReadWeights.
ParserNetworkOptions ReadParserNetworkOptions(const std::filesystem::path& run_or_weights);

}  // namespace daumier::sketch
