#include "systems/sketch/train/system_functions.h"

#include "core/median_time.h"
#include "core/options.h"
#include "systems/sketch/options.h"
#include "systems/sketch/train/evaluation.h"
#include "systems/sketch/train/run.h"
#include "systems/sketch/train/training.h"
#include "tensor/torch_version.h"
#include "train/run_folder.h"

namespace daumier::sketch {

Json ResolveTraining(const Json& config, const std::string& where) {
  return ToJson(train::ParseTraining<SketchTrainingOptions>(config, where));
}

Json ResolveEvaluation(const Json& options, const std::string& where) {
  return ToJson(ParseOptions<SketchEvalOptions>(options, where));
}

TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases, const Task&) {
  return TrainSketch(config, place.directory, place.resume, DeviceName(place.device), databases);
}

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

}  // namespace daumier::sketch
