#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "core/weights_folder.h"
#include "export/exported_function.h"
#include "export/model_card.h"

#include <torch/nn/module.h>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace daumier::exporting {

/// The export of a finished run of any task.
struct RunExport {
  std::filesystem::path run_directory;
  Manifest run_manifest;
  std::shared_ptr<torch::nn::Module> module;
  ExportedFunction function;
  CardText card;
  Json counts;
  Json details = Json::object();  ///< Of the export's manifest, in addition to opset and run_data_hash.
  /// Writes further files into the folder, the template among them, and returns their checksums by name. May be empty.
  std::function<std::map<std::string, std::string>(const std::filesystem::path& folder)> write_rest = {};
  /// How the run becomes shipped weights (export/weights.h); absent where its task has none.
  struct ForWeights {
    Json network;  ///< From these options SystemTraining::make_network makes the network, without its numbers.
    /// Writes what a prediction needs in addition into `folder`, which will lie in `neighbours`. May be empty.
    std::function<WeightsParts(const std::filesystem::path& folder, const std::filesystem::path& neighbours)>
        write_rest;
  };
  std::optional<ForWeights> for_weights = {};
  /// Puts samples of the run's data in the place of the function's own, where the data are there. May be empty.
  std::function<void(ExportedFunction& function)> find_samples = {};
};

inline NetworkFunction NetworkOf(const RunExport& run) {
  return {run.module, run.function};
}

/// The function of an export with the samples on which it is compared: those of the run's data, if there are any.
ExportedFunction FunctionWithSamples(const RunExport& run);

/// Writes `out_directory`: model.onnx, parity.json, model_card.md, the files of write_rest and manifest.json
/// (kind "export", sources and licences of the run). Warns where there is no ONNX Runtime to compare
/// with. Returns the content of parity.json. An earlier export at that place is replaced.
/// @throws Error as ExportToOnnx and CheckParity, and if `out_directory` holds anything but an export; nothing is left
/// behind and nothing is replaced then.
Json WriteExport(const RunExport& run, const std::filesystem::path& out_directory);

/// report/metrics.json of a run, absent if it has not been evaluated. @throws Error naming the file if it is malformed.
std::optional<Json> ReadRunMetrics(const std::filesystem::path& run_directory);

/// Writes the graph into the run folder as best/model.onnx, in addition to the weights that it holds, and notes its
/// checksum in the run's manifest. @throws Error as ExportToOnnx.
void StoreGraph(const RunExport& run);

}  // namespace daumier::exporting
