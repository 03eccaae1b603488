#include "systems/expression/system.h"

#include "faces/import/mesh_folder.h"
#include "systems/expression/options.h"
#include "systems/expression/predictor.h"

namespace daumier::expression {

std::vector<reports::Metric> ErrorColumns() {
  return {{.key = "error", .title = "wrong", .unit = "%", .digits = 1, .scale = 100}};
}

systems::System ExpressionSystem() {
  return {
      .name = kSystem,
      .room = "systems/expression",
      .training_help = [] { return HelpText<TrainingOptions>(); },
      .evaluation_help = [] { return HelpText<EvalOptions>(); },
      .resolve_config = [](const Json& config,
                           const std::string& where) { return ToJson(ParseTraining<TrainingOptions>(config, where)); },
      .resolve_evaluation = [](const Json& options,
                               const std::string& where) { return ToJson(ParseOptions<EvalOptions>(options, where)); },
      .read_metrics =
          [](const Json& metrics) {
            return reports::TableFromMetrics(metrics, ErrorColumns(), "a run that classifies expressions");
          },
      .summary_columns = [] { return std::vector<reports::Metric>(); },
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<PredictOptions>(options, where));
          },
      .open = OpenPredictor,
      .read_inputs =
          [](const std::filesystem::path& file) { return std::vector<systems::Input>{faces::ReadMesh(file)}; },
      .input_extensions = {".obj", ".ply"},
      .result_files = {".json"},
  };
}

}  // namespace daumier::expression
