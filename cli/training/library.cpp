// The training library: rows of the systems' LibTorch half, and what is the same for all of them.
#include "core/run_manifest.h"
#include "core/runtime.h"
#include "export/torch_runner.h"
#include "systems/deform/train/system.h"
#include "systems/sketch/train/system.h"
#include "systems/training_library.h"
#include "tensor/runtime.h"

#include <ATen/Parallel.h>
#include <ATen/ops/mm.h>
#include <torch/cuda.h>
#include <torch/version.h>

#include <algorithm>
#include <chrono>

namespace daumier {
namespace {

const systems::TrainingLibrary& Library();

exporting::RunExport Describe(const std::filesystem::path& run) {
  return Library().at(SystemOf(ReadFinishedRun(run))).describe_export(run);
}

/// GFLOP/s of LibTorch's own float product of two matrices of that side: the best of some.
double MeasureMm(int64_t side = 1024, int repeats = 6) {
  const torch::Tensor a = torch::ones({side, side}), b = torch::ones({side, side});
  double best = 0;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    at::mm(a, b);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
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

const systems::TrainingLibrary& Library() {
  static const systems::TrainingLibrary library{
      .version = DAUMIER_VERSION,
      .systems = {sketch::SketchTraining(), deform::DeformTraining()},
      .set_up = [](int threads) { tensor::SetUpTorch(threads); },
      .describe = DescribeLibTorch,
      .open_network = [](const std::filesystem::path& run,
                         const Device& device) -> std::unique_ptr<runtime::NetworkRunner> {
        return std::make_unique<exporting::TorchRunner>(Describe(run), tensor::TorchDevice(device));
      },
      .export_run = [](const std::filesystem::path& run, const std::filesystem::path& out,
                       const Task&) { return exporting::WriteExport(Describe(run), out); },
      .ablate = nullptr,
  };
  return library;
}

}  // namespace
}  // namespace daumier

extern "C" __attribute__((visibility("default"))) const daumier::systems::TrainingLibrary* daumier_training_library() {
  return &daumier::Library();
}
