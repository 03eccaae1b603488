#pragma once
#include "models/heat_map_unet.h"
#include "systems/sketch/parser_run_folder.h"

namespace daumier::sketch {

/// A run folder with its network, as evaluation and export use it.
struct ParserRun : ParserRunFolder {
  models::HeatMapUnet network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
};

/// @throws Error as ReadParserRunFolder, or if the weights are of another network.
ParserRun LoadParserRun(const std::filesystem::path& directory);

}  // namespace daumier::sketch
