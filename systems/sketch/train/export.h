#pragma once
#include "core/json.h"
#include "export/exported_function.h"
#include "systems/sketch/train/network.h"

#include <filesystem>

namespace daumier::sketch {

/// The network as a function of what it reads, sketch (N, 1, R, R), points (N, 4, P) and shape (N, S), to u (N, Ku),
/// v (N, Kv), residual (N, K) of a network that has one, and vertices (N, V, 3) in cm.
exporting::ExportedFunction SketchFunction(SketchNetwork network);

/// Exports a finished sketch run as exporting::WriteExport does. @throws Error as LoadSketchRun and exporting::WriteExport.
Json ExportSketchRun(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory);

}  // namespace daumier::sketch
