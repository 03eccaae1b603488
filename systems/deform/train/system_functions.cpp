#include "systems/deform/train/system_functions.h"

#include "core/median_time.h"
#include "core/options.h"
#include "systems/deform/options.h"
#include "systems/deform/train/evaluation.h"
#include "systems/deform/train/run.h"
#include "systems/deform/train/surface_decoder.h"
#include "systems/deform/train/training.h"
#include "train/run_folder.h"

namespace daumier::deform {

Json ResolveTraining(const Json& config, const std::string& where) {
  return ToJson(train::ParseTraining<DeformTrainingOptions>(config, where));
}

Json ResolveEvaluation(const Json& options, const std::string& where) {
  return ToJson(ParseOptions<DeformEvalOptions>(options, where));
}

TrainingSummary Train(const Json& config, const systems::RunPlace& place, FolderCache& databases, const Task&) {
  return TrainDeform(config, place.directory, place.resume, DeviceName(place.device), databases);
}

reports::Evaluation Evaluate(const std::filesystem::path& run, const Json& options, FolderCache& databases,
                             const Task& task) {
  return EvaluateDeformRun(run, ParseOptions<DeformEvalOptions>(options), databases, task);
}

double InferMs(const std::filesystem::path& run) {
  const DeformRun loaded = LoadDeformRun(run);
  return MedianMs([&] { SurfaceDecoder(loaded.network, loaded.codes[0]).Vertices(); });
}

}  // namespace daumier::deform
