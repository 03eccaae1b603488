#pragma once
#include "systems/sketch/run_folder.h"
#include "systems/sketch/train/network.h"

namespace daumier::sketch {

/// A run folder with its network, as training, evaluation and export use it.
struct SketchRun : SketchRunFolder {
  SketchNetwork network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
};

/// @throws Error as ReadSketchRunFolder, or if the weights are of another network.
SketchRun LoadSketchRun(const std::filesystem::path& directory);

}  // namespace daumier::sketch
