// The sketch network in both memory layouts: a training step of 32 sketches, and one sketch to vertices.
#include "losses/vertex_loss.h"
#include "models/sketch_network.h"
#include "tensor/runtime.h"
#include "tests/support/random_bilinear.h"

#include <benchmark/benchmark.h>
#include <torch/torch.h>

namespace daumier {
namespace {

constexpr int kNumVertices = 4284;

models::FittedModels Models() {
  return {testing::RandomBilinear(kNumVertices, 50, 16, 1), testing::RandomBilinear(200, 50, 16, 2), {}};
}

models::SketchNetwork MakeNetwork() {
  tensor::SetUpTorch();
  torch::manual_seed(1);
  return models::SketchNetwork(models::SketchNetworkOptions(), Models());
}

void TrainingStep(benchmark::State& state) {
  auto network = MakeNetwork();
  const auto format = state.range(0) == 0 ? at::MemoryFormat::Contiguous : at::MemoryFormat::ChannelsLast;
  for (auto& parameter : network->parameters()) {
    if (parameter.dim() == 4) parameter.set_data(parameter.data().contiguous(format));
  }
  const int64_t batch = 32;
  const int64_t side = network->options().resolution;
  const auto images = (torch::rand({batch, 1, side, side}) < 0.05).to(torch::kFloat32).contiguous(format);
  const losses::GramVertexLoss loss(network->basis(), torch::ones({kNumVertices}));
  const auto moments = loss.Moments(torch::randn({batch, 3 * kNumVertices}));
  torch::optim::Adam adam(network->parameters());
  for (auto _ : state) {
    adam.zero_grad();
    loss(network->Linear(network->forward({images, {}, {}})), moments).backward();
    adam.step();
  }
  state.counters["sketches"] = benchmark::Counter(batch, benchmark::Counter::kIsIterationInvariantRate);
}

void Inference(benchmark::State& state) {
  auto network = MakeNetwork();
  network->eval();
  torch::NoGradGuard no_grad;
  const int64_t side = network->options().resolution;
  const auto image = torch::rand({1, 1, side, side});
  for (auto _ : state) benchmark::DoNotOptimize(network->Decode(network->forward({image, {}, {}})));
}

BENCHMARK(TrainingStep)->ArgName("channels_last")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Inference)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace daumier
