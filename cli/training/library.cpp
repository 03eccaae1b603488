// The training library: rows of the systems' LibTorch half, and what is the same for all of them.
#include "ablation/ablation.h"
#include "ablation/runs.h"
#include "core/error.h"
#include "core/files.h"
#include "core/run_manifest.h"
#include "core/runtime.h"
#include "core/stopwatch.h"
#include "core/weights_folder.h"
#include "export/torch_runner.h"
#include "export/weights.h"
#include "systems/deform/train/system.h"
#include "systems/portrait/train/system.h"
#include "systems/sketch/train/system.h"
#include "systems/training_library.h"
#include "tensor/runtime.h"

#include <ATen/Parallel.h>
#include <ATen/ops/mm.h>
#include <torch/cuda.h>
#include <torch/version.h>

#include <algorithm>

namespace daumier {
namespace {

const systems::TrainingLibrary& Library();

exporting::RunExport Describe(const std::filesystem::path& run) {
  return Library().at(SystemOf(ReadFinishedRun(run))).describe_export(run);
}

exporting::NetworkFunction OpenNetwork(const std::filesystem::path& run_or_weights) {
  if (!IsWeightsFolder(run_or_weights)) return NetworkOf(Describe(run_or_weights));
  const Manifest manifest = ReadWeights(run_or_weights, "", {kWeightsNetwork});
  const systems::SystemTraining& system = Library().at(SystemOf(manifest));
  DAUMIER_CHECK(system.make_network != nullptr, "{}: networks of the task '{}' are not shipped as weights",
                run_or_weights.string(), system.name);
  return exporting::ReadWeightsNetwork(run_or_weights, manifest.details, system.make_network);
}

Json WriteWeights(const systems::WeightsOrder& order, const Task&) {
  const systems::SystemTraining& system = Library().at(SystemOf(ReadFinishedRun(order.run)));
  exporting::WeightsRequest request{.out = order.out, .training_seconds = ablation::TrainSeconds(order.run)};
  if (!order.recipe.empty()) request.recipe = exporting::ReadRecipe(order.recipe);
  if (!order.notes.empty()) request.notes = ReadFile(order.notes);
  return exporting::WriteWeights(system.describe_export(order.run), system.make_network, request);
}

/// GFLOP/s of LibTorch's own float product of two matrices of that side: the best of some.
double MeasureMm(int64_t side = 1024, int repeats = 6) {
  const torch::Tensor a = torch::ones({side, side}), b = torch::ones({side, side});
  double best = 0;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch stopwatch;
    at::mm(a, b);
    const double seconds = stopwatch.seconds();
    best = std::max(best, 2e-9 * double(side * side * side) / seconds);
  }
  return best;
}

Json DescribeLibTorch() {
  return {{"libtorch", TORCH_VERSION},
          {"device", torch::cuda::is_available() ? "cuda" : "cpu"},
          {"threads", at::get_num_threads()},
          {"sgemm_gflops", MeasureMm()}};
}

std::string Text(ablation::RowState state) {
  switch (state) {
    case ablation::RowState::kToTrain:
      return "to train";
    case ablation::RowState::kToResume:
      return "to resume";
    case ablation::RowState::kToEvaluate:
      return "to evaluate";
    case ablation::RowState::kDone:
      return "done";
  }
  return "";
}

Json Ablate(const systems::AblationRequest& request, const systems::System& system, const Task& task) {
  const ablation::AblationSystem of_rows{system, Library().at(system.name), request.device};
  const ablation::Ablation ablation = ablation::LoadAblation(request.config, request.overrides, system.run_options);
  if (!request.dry_run) return ablation::RunAblation(ablation, of_rows, request.out, request.only, task);
  Json plan = Json::array();
  for (const ablation::AblationStep& step : ablation::PlanAblation(ablation, of_rows, request.out, request.only))
    plan.push_back({{"row", step.row}, {"split", step.split}, {"seed", step.seed}, {"state", Text(step.state)}});
  return plan;
}

Json BaseConfig(const systems::AblationRequest& request) {
  return ablation::LoadAblation(request.config, request.overrides, {}).rows.front().config;
}

std::vector<systems::SystemTraining> AllTrainings() {
  std::vector<systems::SystemTraining> rows = sketch::SketchTrainings();
  rows.push_back(deform::DeformTraining());
  for (const systems::SystemTraining& row : portrait::PortraitTrainings()) rows.push_back(row);
  return rows;
}

const systems::TrainingLibrary& Library() {
  static const systems::TrainingLibrary library{
      .version = DAUMIER_VERSION,
      .systems = AllTrainings(),
      .set_up = [](int threads) { tensor::SetUpTorch(threads); },
      .describe = DescribeLibTorch,
      .open_network = [](const std::filesystem::path& run,
                         const Device& device) -> std::unique_ptr<runtime::NetworkRunner> {
        return std::make_unique<exporting::TorchRunner>(OpenNetwork(run), tensor::TorchDevice(device));
      },
      .export_run = [](const std::filesystem::path& run, const std::filesystem::path& out,
                       const Task&) { return exporting::WriteExport(Describe(run), out); },
      .write_weights = WriteWeights,
      .ablation_config = BaseConfig,
      .ablate = Ablate,
  };
  return library;
}

}  // namespace
}  // namespace daumier

extern "C" __attribute__((visibility("default"))) const daumier::systems::TrainingLibrary* daumier_training_library() {
  return &daumier::Library();
}
