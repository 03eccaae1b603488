#pragma once
#include "export/run_export.h"
#include "systems/sketch/train/network.h"

#include <filesystem>

namespace daumier::sketch {

/// The network as a function of what it reads, sketch (N, 1, R, R), points (N, 4, P) and shape (N, S), to u (N, Ku),
/// v (N, Kv), residual (N, K) of a network that has one, and vertices (N, V, 3) in cm.
exporting::ExportedFunction SketchFunction(SketchNetwork network);

/// The network of shipped weights, without their numbers. network: NetworkToJson of SketchNetworkOfWeights.
exporting::NetworkFunction MakeSketchFunction(const Json& network);

/// The export of a finished sketch run. @throws Error as LoadSketchRun.
exporting::RunExport DescribeSketchExport(const std::filesystem::path& run_directory);

}  // namespace daumier::sketch
