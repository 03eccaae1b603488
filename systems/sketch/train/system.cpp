#include "systems/sketch/train/system.h"

#include "core/median_time.h"
#include "export/run_export.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/gesture_evaluation.h"
#include "systems/sketch/train/gesture_export.h"
#include "systems/sketch/train/gesture_run.h"
#include "systems/sketch/train/gesture_training.h"
#include "systems/sketch/train/parser_evaluation.h"
#include "systems/sketch/train/parser_export.h"
#include "systems/sketch/train/parser_run.h"
#include "systems/sketch/train/parser_training.h"
#include "systems/sketch/train/run.h"
#include "systems/sketch/train/training.h"
#include "tensor/torch_version.h"

namespace daumier::sketch {
namespace {

reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                             const Task& task) {
  return EvaluateSketchRun(run, ParseOptions<SketchEvalOptions>(options), databases, task);
}

double InferMs(const std::filesystem::path& run) {
  const at::NoGradGuard no_grad;
  SketchNetwork network = LoadSketchRun(run).network;
  const SketchNetworkOptions& options = network->options();
  const SketchInput sketch{torch::zeros({1, 1, options.resolution, options.resolution}),
                           torch::zeros({1, 4, options.num_points}), torch::zeros({1, network->num_shape()})};
  return MedianMs([&] { network->Decode(network->forward(sketch)); });
}

reports::Evaluation EvaluateParserJson(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                                       const Task& task) {
  return EvaluateParser(run, ParseOptions<ParserEvalOptions>(options), databases, task);
}

double ParserInferMs(const std::filesystem::path& run) {
  const at::NoGradGuard no_grad;
  const ParserRun loaded = LoadParserRun(run);
  const int side = loaded.network_options.resolution;
  models::HeatMapUnet network = loaded.network;
  const torch::Tensor picture = torch::zeros({1, 1, side, side});
  return MedianMs([&] { network->forward(picture); });
}

reports::Evaluation EvaluateGesturesJson(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                                         const Task& task) {
  return EvaluateGestures(run, ParseOptions<GestureEvalOptions>(options), databases, task);
}

double GestureInferMs(const std::filesystem::path& run) {
  const at::NoGradGuard no_grad;
  const GestureRun loaded = LoadGestureRun(run);
  const int side = loaded.network_options.raster().side;
  torch::nn::Sequential network = loaded.network;
  const torch::Tensor picture = torch::zeros({1, 1, side, side});
  return MedianMs([&] { network->forward(picture); });
}

}  // namespace

systems::SystemTraining SketchTraining() {
  return {.name = kSystem,
          .train = TrainSketch,
          .evaluate = Evaluate,
          .describe_export = DescribeSketchExport,
          .infer_ms = InferMs,
          .validation_metric = "mean_vertex_error_mm",
          .make_network = MakeSketchFunction};
}

systems::SystemTraining ParserTraining() {
  return {.name = kParserSystem,
          .train = TrainParser,
          .evaluate = EvaluateParserJson,
          .describe_export = DescribeParserExport,
          .infer_ms = ParserInferMs,
          .validation_metric = "nme_percent",
          .make_network = MakeParserFunction};
}

systems::SystemTraining GestureTraining() {
  return {.name = kGestureSystem,
          .train = TrainGestures,
          .evaluate = EvaluateGesturesJson,
          .describe_export = DescribeGestureExport,
          .infer_ms = GestureInferMs,
          .validation_metric = "error_percent",
          .make_network = MakeGestureFunction};
}

std::vector<systems::SystemTraining> SketchTrainings() {
  return {SketchTraining(), ParserTraining(), GestureTraining()};
}

}  // namespace daumier::sketch
