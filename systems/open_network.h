#pragma once
#include "core/device.h"
#include "runtime/network_runner.h"

#include <filesystem>
#include <memory>

namespace daumier::systems {

/// The network of a finished run or of shipped weights: by runtime/ from its graph, on the CPU; by LibTorch on other
/// devices, and for runs and weights of earlier versions, which have no graph.
/// @throws Error as ReadFinishedRun, ReadWeights, runtime::ReadOnnx and LoadTrainingLibrary.
std::unique_ptr<runtime::NetworkRunner> OpenNetwork(const std::filesystem::path& run_or_weights, const Device& device);

}  // namespace daumier::systems
