#pragma once
#include "core/json.h"
#include "export/exported_function.h"
#include "models/sketch_network.h"

#include <filesystem>

namespace daumier::exporting {

/// The network as a function of what it reads, sketch (N, 1, R, R), points (N, 4, P) and shape (N, S), to u (N, Ku),
/// v (N, Kv), residual (N, K) of a network that has one, and vertices (N, V, 3) in cm.
ExportedFunction SketchFunction(models::SketchNetwork network);

/// Exports a finished sketch run into `out_directory`: model.onnx, parity.json, model_card.md,
/// template.{safetensors,json} and manifest.json (kind "export", sources and licences of the run). Warns where there is
/// no ONNX Runtime to compare with. Returns what stands in parity.json. An earlier export at that place is replaced.
/// @throws Error as LoadSketchRun, ExportToOnnx and CheckParity, and if `out_directory` holds anything but an export;
/// nothing is left behind and nothing is replaced then.
Json ExportSketchRun(const std::filesystem::path& run_directory, const std::filesystem::path& out_directory);

}  // namespace daumier::exporting
