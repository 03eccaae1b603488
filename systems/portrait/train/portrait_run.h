#pragma once
#include "systems/portrait/portrait_run_folder.h"
#include "systems/portrait/train/portrait_network.h"

namespace daumier::portrait {

/// A run folder with its network, as evaluation and export use it.
struct PortraitRun : PortraitRunFolder {
  PortraitNetwork network{nullptr};  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
};

/// @throws Error as ReadPortraitRunFolder, or if the weights are of another network.
PortraitRun LoadPortraitRun(const std::filesystem::path& directory);

}  // namespace daumier::portrait
