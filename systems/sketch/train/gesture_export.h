#pragma once
#include "export/run_export.h"
#include "systems/sketch/gesture_network_options.h"

#include <torch/nn/modules/container/sequential.h>

#include <filesystem>

namespace daumier::sketch {

/// The network as a function of `pictures` (N, 1, S, S) of strokes, ink 1, to `scores` (N, 11) before any softmax, the
/// last one that of no gesture.
exporting::ExportedFunction GestureFunction(torch::nn::Sequential network, const GestureNetworkOptions& options);

/// The network of shipped weights, without their numbers. network: GestureNetworkOptions. @throws UsageError as
/// ParseOptions.
exporting::NetworkFunction MakeGestureFunction(const Json& network);

/// The export of a finished run; weights hold details.rejection. @throws Error as LoadGestureRun.
exporting::RunExport DescribeGestureExport(const std::filesystem::path& run_directory);

}  // namespace daumier::sketch
