// LibTorch's matrix product and oneDNN's own sgemm side by side: core/blas_shim.cpp should leave no difference.
#include "tensor/runtime.h"

#include <benchmark/benchmark.h>
#include <dnnl.h>
#include <torch/utils.h>

namespace daumier {
namespace {

struct Product {
  torch::Tensor a, b, c;
};

Product MakeProduct(int64_t n) {
  tensor::SetUpTorch();
  torch::manual_seed(1);
  return {torch::randn({n, n}), torch::randn({n, n}), torch::empty({n, n})};
}

void CountFlops(benchmark::State& state) {
  const double n = static_cast<double>(state.range(0));
  state.counters["FLOP/s"] = benchmark::Counter(2 * n * n * n, benchmark::Counter::kIsIterationInvariantRate);
}

void LibTorch(benchmark::State& state) {
  auto p = MakeProduct(state.range(0));
  for (auto _ : state) at::mm_out(p.c, p.a, p.b);
  CountFlops(state);
}

void OneDnn(benchmark::State& state) {
  const int64_t n = state.range(0);
  auto p = MakeProduct(n);
  for (auto _ : state) {
    dnnl_sgemm('N', 'N', n, n, n, 1.0f, p.a.data_ptr<float>(), n, p.b.data_ptr<float>(), n, 0.0f, p.c.data_ptr<float>(),
               n);
  }
  CountFlops(state);
}

BENCHMARK(LibTorch)->RangeMultiplier(2)->Range(32, 1024)->UseRealTime();
BENCHMARK(OneDnn)->RangeMultiplier(2)->Range(32, 1024)->UseRealTime();

}  // namespace
}  // namespace daumier
