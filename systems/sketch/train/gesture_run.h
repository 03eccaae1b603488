#pragma once
#include "systems/sketch/gesture_run_folder.h"

#include <torch/nn/modules/container/sequential.h>

namespace daumier::sketch {

/// A run folder with its network, as export uses it.
struct GestureRun : GestureRunFolder {
  torch::nn::Sequential network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
};

/// @throws Error as ReadGestureRunFolder, or if the weights are of another network.
GestureRun LoadGestureRun(const std::filesystem::path& directory);

}  // namespace daumier::sketch
