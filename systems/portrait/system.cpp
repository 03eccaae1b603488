#include "systems/portrait/system.h"

#include "core/training.h"
#include "systems/portrait/landmark_evaluation_options.h"
#include "systems/portrait/landmark_metrics.h"
#include "systems/portrait/landmark_options.h"
#include "systems/portrait/landmark_predictor.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_system.h"

namespace daumier::portrait {
systems::System LandmarkSystem() {
  return {
      .name = kLandmarkSystem,
      .room = "systems/portrait",
      .training_help = [] { return HelpText<LandmarkTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<LandmarkEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            return ToJson(ParseTraining<LandmarkTrainingOptions>(config, where));
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            const auto parsed = ParseOptions<LandmarkEvalOptions>(options, where);
            if (!parsed.rival.empty() && parsed.pictures.empty())
              throw UsageError(fmt::format("{}: rival needs pictures, the folder of what it was found in", where));
            return ToJson(parsed);
          },
      .read_metrics =
          [](const Json& metrics) { return reports::TableFromMetrics(metrics, LandmarkColumns(), "a landmark run"); },
      .summary_columns = LandmarkSummaryColumns,
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<LandmarkPredictOptions>(options, where));
          },
      .open = OpenLandmarkPredictor,
      .read_inputs = ReadPicture,
      .input_extensions = PictureExtensions(),
      .shipped_rank = 1,
      .picture_content = systems::Portraits(),
      .result_files = {".png", ".pts", ".json", "_mask.png"},
  };
}

std::vector<systems::System> PortraitSystems() {
  return {LandmarkSystem(), PortraitSystem()};
}

}  // namespace daumier::portrait
