#include "systems/portrait/train/portrait_system.h"

#include "core/median_time.h"
#include "export/run_export.h"
#include "systems/portrait/train/portrait_evaluation.h"
#include "systems/portrait/train/portrait_export.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "systems/portrait/train/portrait_run.h"
#include "systems/portrait/train/portrait_training.h"

namespace daumier::portrait {
namespace {

reports::Evaluation EvaluatePortrait(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                                     const Task& task) {
  return EvaluatePortraitRun(run, ParseOptions<PortraitEvalOptions>(options), databases, task);
}

double PortraitInferMs(const std::filesystem::path& run) {
  PortraitRun loaded = LoadPortraitRun(run);
  const PortraitRenderer renderer(loaded.model);
  const int64_t r = loaded.options.network.resolution;
  const torch::Tensor input = torch::zeros({1, 3, r, r});
  return MedianMs([&] { renderer.layer().Vertices(PredictPortraits(loaded.network, renderer, input).coefficients); });
}

}  // namespace

systems::SystemTraining PortraitTraining() {
  return {.name = kPortraitSystem,
          .train = TrainPortrait,
          .evaluate = EvaluatePortrait,
          .describe_export = DescribePortraitExport,
          .infer_ms = PortraitInferMs,
          .validation_metric = "vertex_error_mm",
          .make_network = MakePortraitNetwork};
}

}  // namespace daumier::portrait
