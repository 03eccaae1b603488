#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "export/exported_function.h"
#include "export/parity.h"
#include "faces/face_model.h"

#include <torch/nn/module.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace daumier::exporting {

/// A finished run as it is exported, of whatever kind.
struct RunExport {
  std::filesystem::path run_directory;
  const Manifest& run_manifest;
  const torch::nn::Module& module;
  ExportedFunction function;
  const faces::FaceTemplate& face_template;
  Json counts;
  Json details = Json::object();  ///< Of the export's manifest, beside opset and run_data_hash.
  /// Writes further files into the folder and returns their checksums by name; may be empty.
  std::function<std::map<std::string, std::string>(const std::filesystem::path& folder)> write_rest = {};
  /// The model card; metrics: report/metrics.json of the run where it is there.
  std::function<std::string(const ParityReport& parity, const std::optional<Json>& metrics)> model_card;
};

/// Writes `out_directory`: model.onnx, parity.json, model_card.md, template.{safetensors,json}, further files and
/// manifest.json (kind "export", sources and licences of the run). Warns where there is no ONNX Runtime to compare
/// with. Returns what stands in parity.json. An earlier export at that place is replaced.
/// @throws Error as ExportToOnnx and CheckParity, and if `out_directory` holds anything but an export; nothing is left
/// behind and nothing is replaced then.
Json WriteExport(const RunExport& run, const std::filesystem::path& out_directory);

}  // namespace daumier::exporting
