#pragma once
#include "core/json.h"
#include "export/run_export.h"

#include <filesystem>
#include <string>
#include <vector>

/// A finished run as shipped weights (core/weights_folder.h): README.md, network.safetensors in float16, network.onnx, what
/// its system adds, manifest.json.
namespace daumier::exporting {

/// Largest difference that float16 may make in an output, as a share of the output's largest value.
inline constexpr double kHalfTolerance = 0.01;

/// A command of which the weights are the result, and how long it took.
struct RecipeStep {
  std::string command;
  double seconds = 0;
};

struct WeightsRequest {
  std::filesystem::path out;
  double training_seconds = 0;          ///< Of the run.
  std::vector<RecipeStep> recipe = {};  ///< In order; empty: the training alone, from the options in the manifest.
  std::string notes = {};               ///< Markdown for the card: known failures, results on pictures by people.
};

/// Steps of a recipe file: a JSON list of {command, seconds}. @throws Error naming the file if it is malformed.
std::vector<RecipeStep> ReadRecipe(const std::filesystem::path& file);

/// Makes a network of the options that a manifest holds, with any numbers in it.
using MakeNetwork = NetworkFunction (*)(const Json& network);

/// Writes the weights and returns `details` of their manifest. The folder is written whole or not at all; it replaces
/// earlier weights. The written network is read again and run next to that of the run on the same samples.
/// @throws Error if the task has no weights, if the run was not evaluated, as SaveHalfModule, or if an output differs by
/// more than kHalfTolerance; UsageError as CheckReplacedFolder.
Json WriteWeights(const RunExport& run, MakeNetwork make_network, const WeightsRequest& request);

/// Writes the graph of the network that lies in the folder, as kWeightsGraph, and returns its checksum. Tensors of
/// kWeightsNetwork are external (runtime/onnx_file.h). @throws Error as ExportToOnnx.
std::string WriteWeightsGraph(const std::filesystem::path& directory, const NetworkFunction& network);

/// The network of a folder of weights, whose files have been verified.
/// @throws Error naming the file if its numbers are of another network.
NetworkFunction ReadWeightsNetwork(const std::filesystem::path& directory, const Json& details,
                                   MakeNetwork make_network);

}  // namespace daumier::exporting
