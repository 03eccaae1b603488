// The deformable model compared with a plain transcription in LibTorch's operators, in one run: decoding 11,551
// vertices and the same template subdivided three times, and a step of training on 32 faces x 2,048 points.
#include "core/log.h"
#include "geometry/subdivision.h"
#include "models/siren_field.h"
#include "systems/deform/train/siren_deformations.h"
#include "systems/deform/train/surface_decoder.h"
#include "tensor/runtime.h"
#include "tensor/torch_version.h"
#include "train/optimiser.h"

#include <benchmark/benchmark.h>
#include <torch/optim.h>
#include <torch/utils.h>

namespace {

using namespace daumier;

constexpr int64_t kVertices = 11551, kFine = 739138;  // The template of [Jung et al. 2022], and three times subdivided.

torch::Tensor Places(int64_t count) {
  torch::manual_seed(1);
  return torch::rand({count, 3}) * 2 - 1;
}

std::shared_ptr<deform::HypernetworkDeformation> Network() {
  torch::manual_seed(2);
  return std::make_shared<deform::HypernetworkDeformation>(deform::DeformOptions{}, Places(kVertices),
                                                           faces::ModelFrame{});
}

void DecodeFromCode(benchmark::State& state) {
  const at::NoGradGuard no_grad;
  const auto network = Network();
  const torch::Tensor code = 0.01 * torch::randn({128});
  for (auto _ : state) benchmark::DoNotOptimize(deform::SurfaceDecoder(network, code).Vertices());
}
BENCHMARK(DecodeFromCode)->Unit(benchmark::kMillisecond)->UseRealTime();

void DecodeFromCachedParameters(benchmark::State& state) {
  const auto network = Network();
  const deform::SurfaceDecoder decoder(network, 0.01 * torch::randn({128}));
  for (auto _ : state) benchmark::DoNotOptimize(decoder.Vertices());
}
BENCHMARK(DecodeFromCachedParameters)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The points of a fine surface, by our kernel or by operators on all points at once.
void DecodeFine(benchmark::State& state, bool by_operators) {
  const at::NoGradGuard no_grad;
  const runtime::SirenLayout siren;
  const torch::Tensor parameters = Network()->SirenParameters(0.01 * torch::randn({1, 128})), points = Places(kFine);
  for (auto _ : state) {
    benchmark::DoNotOptimize(by_operators ? models::SirenFieldByOperations(siren, parameters, points)
                                          : models::SirenField(siren, parameters, points));
  }
}
BENCHMARK_CAPTURE(DecodeFine, ours, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(DecodeFine, operators, true)->Unit(benchmark::kMillisecond)->UseRealTime();

constexpr int64_t kFaces = 32, kPoints = 2048;

/// A step as `daumier train` takes it, without reading data.
void StepOurs(benchmark::State& state) {
  const auto network = Network();
  train::Optimiser optimiser(*network, {.weight_decay = 0});
  const torch::Tensor points = Places(kFaces * kPoints).reshape({kFaces, kPoints, 3}), targets = points * 1.1;
  const torch::Tensor codes = (0.01 * torch::randn({kFaces, 128})).requires_grad_();
  for (auto _ : state) {
    optimiser.ZeroGradients();
    const torch::Tensor loss =
        3e3 * (network->Deform(codes, {{}, {}, points}) - targets).square().mean() + 1e6 * codes.square().mean();
    loss.backward();
    optimiser.Step(1e-6);
    benchmark::DoNotOptimize(loss.item<float>());
  }
}
BENCHMARK(StepOurs)->Unit(benchmark::kMillisecond)->UseRealTime();

/// The same by LibTorch's operators and its own Adam, no gradient by the coordinates.
void StepByOperators(benchmark::State& state) {
  const auto network = Network();
  torch::optim::Adam optimiser(network->parameters(), torch::optim::AdamOptions(1e-6));
  const torch::Tensor points = Places(kFaces * kPoints).reshape({kFaces, kPoints, 3}), targets = points * 1.1;
  const torch::Tensor codes = (0.01 * torch::randn({kFaces, 128})).requires_grad_();
  for (auto _ : state) {
    optimiser.zero_grad();
    const torch::Tensor positions =
        points + models::SirenFieldByOperations({}, network->SirenParameters(codes), points);
    const torch::Tensor loss = 3e3 * (positions - targets).square().mean() + 1e6 * codes.square().mean();
    loss.backward();
    optimiser.step();
    benchmark::DoNotOptimize(loss.item<float>());
  }
}
BENCHMARK(StepByOperators)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  tensor::SetUpTorch();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
