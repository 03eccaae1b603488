#include "systems/sketch/train/system.h"

#include "core/median_time.h"
#include "export/run_export.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/export.h"
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

}  // namespace

systems::SystemTraining SketchTraining() {
  return {.name = kSystem,
          .train = TrainSketch,
          .evaluate = Evaluate,
          .describe_export = DescribeSketchExport,
          .infer_ms = InferMs,
          .validation_metric = "mean_vertex_error_mm"};
}

}  // namespace daumier::sketch
