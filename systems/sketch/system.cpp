#include "systems/sketch/system.h"

#include "core/training.h"
#include "systems/sketch/evaluation_options.h"
#include "systems/sketch/gesture_evaluation_options.h"
#include "systems/sketch/gesture_metrics.h"
#include "systems/sketch/gesture_options.h"
#include "systems/sketch/gesture_predictor.h"
#include "systems/sketch/input_drawing.h"
#include "systems/sketch/metrics.h"
#include "systems/sketch/options.h"
#include "systems/sketch/parser_evaluation_options.h"
#include "systems/sketch/parser_metrics.h"
#include "systems/sketch/parser_options.h"
#include "systems/sketch/parser_predictor.h"
#include "systems/sketch/parser_run_folder.h"
#include "systems/sketch/predictor.h"
#include "systems/sketch/run_folder.h"

namespace daumier::sketch {
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
      .read_inputs = ReadDrawingInputs,
      .input_extensions = DrawingExtensions(),
      .picture_content = systems::LineDrawings(),
  };
}

systems::System ParserSystem() {
  return {
      .name = kParserSystem,
      .room = "systems/sketch",
      .training_help = [] { return HelpText<ParserTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<ParserEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            return ToJson(ParseTraining<ParserTrainingOptions>(config, where));
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<ParserEvalOptions>(options, where));
          },
      .read_metrics =
          [](const Json& metrics) {
            return reports::TableFromMetrics(metrics, ParserColumns(), "a run of a drawing parser");
          },
      .summary_columns = ParserSummaryColumns,
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<ParserPredictOptions>(options, where));
          },
      .open = OpenParserPredictor,
      .read_inputs = ReadDrawingInputs,
      .input_extensions = DrawingExtensions(),
      .shipped_rank = -1,
      .picture_content = systems::LineDrawings(),
      .result_files = {".png", ".json"},
  };
}

systems::System GestureSystem() {
  return {
      .name = kGestureSystem,
      .room = "systems/sketch",
      .training_help = [] { return HelpText<GestureTrainingOptions>(); },
      .evaluation_help = [] { return HelpText<GestureEvalOptions>(); },
      .resolve_config =
          [](const Json& config, const std::string& where) {
            return ToJson(ParseTraining<GestureTrainingOptions>(config, where));
          },
      .resolve_evaluation =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<GestureEvalOptions>(options, where));
          },
      .read_metrics =
          [](const Json& metrics) {
            return reports::TableFromMetrics(metrics, GestureColumns(), "a run that classifies gestures");
          },
      .summary_columns = GestureSummaryColumns,
      .resolve_prediction =
          [](const Json& options, const std::string& where) {
            return ToJson(ParseOptions<GesturePredictOptions>(options, where));
          },
      .open = OpenGesturePredictor,
      .read_inputs = ReadDrawingInputs,
      .input_extensions = DrawingExtensions(),
      .shipped_rank = -2,
      .picture_content = systems::LineDrawings(),
      .result_files = {".png", ".json"},
  };
}

std::vector<systems::System> SketchSystems() {
  return {SketchSystem(), ParserSystem(), GestureSystem()};
}

}  // namespace daumier::sketch
