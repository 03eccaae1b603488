#include "train/sketch_ablation.h"

#include "core/error.h"
#include "core/options.h"
#include "eval/sketch_comparison.h"
#include "eval/sketch_eval.h"
#include "models/sketch_run.h"
#include "tensor/torch_version.h"
#include "train/run_folder.h"
#include "train/sketch_recipe.h"

#include <torch/utils.h>

#include <algorithm>

namespace daumier::train {

namespace fs = std::filesystem;

Json SketchAblation::ResolvedConfig(Json config, uint64_t seed, const std::string& split,
                                    const std::string& where) const {
  config.merge_patch({{"seed", seed}, {"split", {{"kind", split}}}});
  const auto options = ParseTraining<SketchTrainingOptions>(config, where);
  models::RequireWholeBlocks(options.network);
  return ToJson(options);
}

Json SketchAblation::ResolvedEval(const Json& eval, const std::string& where) const {
  return ToJson(ParseOptions<eval::SketchEvalOptions>(eval, where));
}

void SketchAblation::TrainRun(const Json& config, const fs::path& run, bool resume, const std::string& device) const {
  TrainSketch(config, run, resume, device);
}

void SketchAblation::Evaluate(const fs::path& run, const Json& eval, const fs::path& report) const {
  eval::EvaluateSketchRun(run, report, ParseOptions<eval::SketchEvalOptions>(eval));
}

double SketchAblation::InferMs(const fs::path& run) const {
  const at::NoGradGuard no_grad;
  models::SketchNetwork network = models::LoadSketchRun(run).network;
  const models::SketchNetworkOptions& options = network->options();
  const models::SketchInput sketch{torch::zeros({1, 1, options.resolution, options.resolution}),
                                   torch::zeros({1, 4, options.num_points}), torch::zeros({1, network->num_shape()})};
  return MedianMs([&] { network->Decode(network->forward(sketch)); });
}

std::vector<std::string> SketchAblation::baselines() const {
  return {"mean face", "nearest neighbour", "ridge regression", "limit of the model"};
}

AblationMeasure SketchAblation::Measure(const Json& metrics, const std::string& line,
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
    AblationMeasure measure{
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

void SketchAblation::WriteSheet(const std::vector<AblationPicture>& rows, const fs::path& file) const {
  const Json& metrics = rows.front().metrics;
  std::vector<eval::ComparedRun> runs;
  for (const AblationPicture& row : rows) {
    runs.push_back({row.name, row.run, ParseOptions<eval::SketchEvalOptions>(row.eval)});
    if (row.shape_input == "given") runs.back().options.recover_with.clear();
  }
  render::WriteImage(
      file, eval::SketchComparison(runs, eval::ChooseFaces(metrics.at("faces").get<std::vector<int>>(),
                                                           metrics.at("face_errors_mm").get<std::vector<double>>())));
}

}  // namespace daumier::train
