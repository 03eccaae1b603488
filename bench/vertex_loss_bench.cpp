// The two forms of the vertex loss side by side: forward and backward of a batch of 32, as in training.
#include "losses/vertex_loss.h"
#include "tensor/runtime.h"

#include <benchmark/benchmark.h>
#include <torch/utils.h>

namespace daumier {
namespace {

struct Batch {
  torch::Tensor core, u, v, target, weights;
};

/// u (x) v.
torch::Tensor Products(const Batch& batch) {
  return (batch.u.unsqueeze(2) * batch.v.unsqueeze(1)).flatten(1);
}

/// 50 x 16 weights; the vertices are those of the source.
Batch MakeBatch(int64_t num_vertices) {
  tensor::SetUpTorch();
  torch::manual_seed(1);
  const int64_t batch = 32;
  return {torch::randn({800, 3 * num_vertices}), torch::randn({batch, 50}).set_requires_grad(true),
          torch::randn({batch, 16}).set_requires_grad(true), torch::randn({batch, 3 * num_vertices}),
          torch::ones({num_vertices})};
}

void OverVertices(benchmark::State& state) {
  const auto b = MakeBatch(state.range(0));
  for (auto _ : state) losses::VertexLoss(b.core, Products(b), b.target, b.weights).backward();
}

void ThroughGramMatrix(benchmark::State& state) {
  const auto b = MakeBatch(state.range(0));
  const losses::GramVertexLoss loss(b.core, b.weights);
  const auto moments = loss.Moments(b.target);
  for (auto _ : state) loss(Products(b), moments).backward();
}

/// What the Gram form does once before training, per 32 faces.
void Moments(benchmark::State& state) {
  const auto b = MakeBatch(state.range(0));
  const losses::GramVertexLoss loss(b.core, b.weights);
  for (auto _ : state) benchmark::DoNotOptimize(loss.Moments(b.target));
}

// The cropped heads of MakeHuman and ICT.
BENCHMARK(OverVertices)->Arg(4284)->Arg(11248)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(ThroughGramMatrix)->Arg(4284)->Arg(11248)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(Moments)->Arg(4284)->Arg(11248)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace daumier
