#include "systems/sketch/system.h"

#include "core/training.h"
#include "render/read_drawing.h"
#include "systems/sketch/evaluation_options.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/options.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/run_folder.h"

namespace daumier::sketch {
namespace {

std::vector<systems::Input> ReadInputs(const std::filesystem::path& file) {
  std::vector<systems::Input> inputs;
  for (render::Drawing& drawing : render::ReadDrawings(file)) inputs.emplace_back(std::move(drawing));
  return inputs;
}

}  // namespace

systems::System SketchSystem() {
  return {
      .name = kSystem,
      .room = "systems/sketch",
      .training_help = [] { return HelpText<SketchTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<SketchEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            const auto options = ParseTraining<SketchTrainingOptions>(config, where);
            RequireWholeBlocks(options.network);
            return ToJson(options);
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            const auto parsed = ParseOptions<SketchEvalOptions>(options, where);
            CheckEvalOptions(parsed);
            return ToJson(parsed);
          },
      .read_metrics = ReadSketchMetrics,
      .summary_columns = SketchSummaryColumns,
      .run_options = {"recover_with"},
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<PredictOptions>(options, where));
          },
      .open = OpenSketchPredictor,
      .read_inputs = ReadInputs,
      .input_extensions = {".svg", ".svgz", ".ndjson", ".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tif", ".tiff",
                           ".gif", ".heic", ".xopp", ".inkml", ".excalidraw"},
  };
}

}  // namespace daumier::sketch
