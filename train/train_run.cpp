#include "train/train_run.h"

#include "core/config.h"
#include "core/files.h"
#include "core/log.h"
#include "core/run_manifest.h"
#include "train/run_folder.h"
#include "train/trainer.h"

namespace daumier::train {

bool StartRun(const std::filesystem::path& directory, bool resume, const RunStart& start) {
  const Json& config = start.manifest.config;
  const Json data = start.manifest.details.value("data", Json::object());
  if (resume) LengthenFinishedRun(directory, config, data, start.defaults);
  const bool begun = OpenRunFolder(directory, resume, config, data, start.defaults);
  if (begun) VerifyChecksums(directory, ReadManifest(directory, "run"));
  // Of all files the first one: it shows that the folder is a run's. Of a resumed run the data may have moved.
  WriteFileIfChanged(ResolvedConfig(directory), ToToml(start.options));
  if (!begun) WriteManifest(directory, start.manifest);
  return begun;
}

TrainingSummary TrainRun(Recipe& recipe, const TrainerOptions& trainer, const OptimiserOptions& optimiser,
                         uint64_t seed, const std::filesystem::path& directory, const Task& task) {
  const int64_t num_parameters = NumParameters(recipe.product());
  log::Info("Training {} parameters on {} samples", num_parameters, recipe.num_samples());
  TrainingSummary summary = Train(recipe, trainer, optimiser, seed, directory, task, EarlierTrainings(directory));
  FinishRun(directory, summary, num_parameters);
  return summary;
}

int64_t NumParameters(const torch::nn::Module& module) {
  int64_t count = 0;
  for (const torch::Tensor& parameter : module.parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::train
