#include "systems/portrait/train/system.h"

#include "core/median_time.h"
#include "systems/portrait/train/landmark_evaluation.h"
#include "systems/portrait/train/landmark_export.h"
#include "systems/portrait/train/landmark_run.h"
#include "systems/portrait/train/landmark_training.h"
#include "systems/portrait/train/portrait_system.h"
#include "tensor/torch_version.h"

namespace daumier::portrait {
namespace {

reports::Evaluation EvaluateLandmarkJson(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                                         const Task& task) {
  return EvaluateLandmarks(run, ParseOptions<LandmarkEvalOptions>(options), databases, task);
}

double LandmarkInferMs(const std::filesystem::path& run) {
  const at::NoGradGuard no_grad;
  const LandmarkRun loaded = LoadLandmarkRun(run);
  const int side = loaded.network_options.resolution;
  models::HeatMapUnet network = loaded.network;
  const torch::Tensor picture = torch::zeros({1, 3, side, side});
  return MedianMs([&] { network->forward(picture); });
}

}  // namespace

systems::SystemTraining LandmarkTraining() {
  return {.name = kLandmarkSystem,
          .train = TrainLandmarks,
          .evaluate = EvaluateLandmarkJson,
          .describe_export = DescribeLandmarkExport,
          .infer_ms = LandmarkInferMs,
          .validation_metric = "nme_percent",
          .make_network = MakeLandmarkFunction};
}

std::vector<systems::SystemTraining> PortraitTrainings() {
  return {LandmarkTraining(), PortraitTraining()};
}

}  // namespace daumier::portrait
