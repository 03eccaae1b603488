#include "systems/portrait/portrait_system.h"

#include "core/training.h"
#include "systems/portrait/picture_files.h"
#include "systems/portrait/portrait_evaluation_options.h"
#include "systems/portrait/portrait_metrics.h"
#include "systems/portrait/portrait_options.h"
#include "systems/portrait/portrait_predictor.h"

namespace daumier::portrait {

systems::System PortraitSystem() {
  return {
      .name = kPortraitSystem,
      .room = "systems/portrait",
      .training_help = [] { return HelpText<PortraitTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<PortraitEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            return ToJson(ParseTraining<PortraitTrainingOptions>(config, where));
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<PortraitEvalOptions>(options, where));
          },
      .read_metrics =
          [](const Json& metrics) { return reports::TableFromMetrics(metrics, PortraitColumns(), "a portrait run"); },
      .summary_columns = PortraitSummaryColumns,
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<PortraitPredictOptions>(options, where));
          },
      .open = OpenPortraitPredictor,
      .read_inputs = ReadPicture,
      .input_extensions = PictureExtensions(),
      .shipped_rank = 2,
      .picture_content = systems::Portraits(),
  };
}

}  // namespace daumier::portrait
