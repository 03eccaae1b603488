#include "systems/sketch/train/ablation.h"

#include "core/error.h"
#include "core/options.h"
#include "systems/sketch/train/comparison.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/run.h"
#include "tensor/torch_version.h"
#include "train/run_folder.h"
#include "systems/sketch/options.h"
#include "systems/sketch/train/training.h"

#include <torch/utils.h>

#include <algorithm>

namespace daumier::sketch {

namespace fs = std::filesystem;

Json SketchAblation::ResolvedConfig(Json config, uint64_t seed, const std::string& split,
                                    const std::string& where) const {
  config.merge_patch({{"seed", seed}, {"split", {{"kind", split}}}});
  const auto options = ParseTraining<SketchTrainingOptions>(config, where);
  RequireWholeBlocks(options.network);
  return ToJson(options);
}

Json SketchAblation::ResolvedEval(const Json& eval, const std::string& where) const {
  return ToJson(ParseOptions<SketchEvalOptions>(eval, where));
}

void SketchAblation::TrainRun(const Json& config, const fs::path& run, bool resume, const std::string& device) const {
  TrainSketch(config, {run, resume, ParseDevice(device)}, {});
}

void SketchAblation::Evaluate(const fs::path& run, const Json& eval, const fs::path& report) const {
  EvaluateSketchRun(run, report, ParseOptions<SketchEvalOptions>(eval));
}

double SketchAblation::InferMs(const fs::path& run) const {
  const at::NoGradGuard no_grad;
  SketchNetwork network = LoadSketchRun(run).network;
  const SketchNetworkOptions& options = network->options();
  const SketchInput sketch{torch::zeros({1, 1, options.resolution, options.resolution}),
                                   torch::zeros({1, 4, options.num_points}), torch::zeros({1, network->num_shape()})};
  return MedianMs([&] { network->Decode(network->forward(sketch)); });
}

std::vector<std::string> SketchAblation::baselines() const {
  return {"mean face", "nearest neighbour", "ridge regression", "limit of the model"};
}

ablation::AblationMeasure SketchAblation::Measure(const Json& metrics, const std::string& line,
                                        const std::string& shape_input) const {
  try {
    const Json &table = metrics.at("table"), &result = metrics.at("shape_input");
    // The report's own result is the line of the network with the shape input that the report tells.
    const Json network = table.at(0).at("name"), name = line.empty() ? network : Json(line);
    const Json input = shape_input.empty() && name == network ? result : Json(shape_input);
    const auto found = std::find_if(table.begin(), table.end(), [&](const Json& entry) {
      return entry.at("name") == name && (input == "" || entry.at("shape_input") == input);
    });
    DAUMIER_CHECK(found != table.end(), "a report has no line '{}'{}", line,
                  shape_input.empty() ? "" : fmt::format(" of shape input '{}'", shape_input));
    ablation::AblationMeasure measure{
        .error = found->at("error").get<double>(),
        .interval = eval::Interval{found->at("error_low").get<double>(), found->at("error_high").get<double>()}};
    for (const auto& [key, value] : found->items())
      if (key != "name" && key != "face_errors_mm" && key.substr(0, 5) != "error") measure.more[key] = value;
    measure.more["num_faces"] = metrics.at("num_faces");
    measure.more["data_hash"] = metrics.at("data_hash");
    measure.of_run = name == network;
    const bool is_result = name == network && found->at("shape_input") == result;
    measure.more["regions_mm"] = is_result ? metrics.at("regions_mm") : Json();
    DAUMIER_CHECK(found->contains("face_errors_mm"),
                  "its report comes from an earlier version, without the errors of each face: delete it, and the same "
                  "command makes it anew");
    measure.face_errors = found->at("face_errors_mm").get<std::vector<double>>();
    measure.groups = metrics.at("groups").get<std::vector<int>>();
    return measure;
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of a sketch run are malformed: {}", error.what()));
  }
}

void SketchAblation::WriteSheet(const std::vector<ablation::AblationPicture>& rows, const fs::path& file) const {
  const Json& metrics = rows.front().metrics;
  std::vector<ComparedRun> runs;
  for (const ablation::AblationPicture& row : rows) {
    runs.push_back({row.name, row.run, ParseOptions<SketchEvalOptions>(row.eval)});
    if (row.shape_input == "given") runs.back().options.recover_with.clear();
  }
  render::WriteImage(
      file, SketchComparison(runs, reports::ChooseFaces(metrics.at("faces").get<std::vector<int>>(),
                                                           metrics.at("face_errors_mm").get<std::vector<double>>())));
}

}  // namespace daumier::sketch
