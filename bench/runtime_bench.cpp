// The networks of the shipped weights by LibTorch and by runtime/, side by side: the time of a run at batch sizes 1, 2
// and 7, by as many threads as OpenMP has (OMP_NUM_THREADS), and how far the outputs are apart, as a share of an
// output's largest value (difference). Plan: the first run of a graph that has been read.
#include "core/error.h"
#include "core/random.h"
#include "core/runtime.h"
#include "core/weights_folder.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "systems/shipped_weights.h"
#include "systems/training_library.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace daumier {
namespace {

/// Numbers from 0 to 1 for every input.
NamedArrays InputsOf(const runtime::Graph& graph, int64_t batch) {
  Rng rng(1);
  NamedArrays inputs;
  for (const runtime::GraphInput& input : graph.inputs) {
    std::vector<int64_t> shape = input.shape;
    for (int64_t& size : shape) size = size == -1 ? batch : size;
    FloatArray& array = inputs[input.name] = FloatArray(shape);
    for (float& number : array.values) number = float(rng.Uniform());
  }
  return inputs;
}

double Difference(const NamedArrays& own, const NamedArrays& other) {
  double share = 0;
  for (const auto& [name, array] : own) {
    const FloatArray& expected = other.at(name);
    DAUMIER_CHECK(array.shape == expected.shape, "the output '{}' has another shape", name);
    double largest = 1e-30, difference = 0;
    for (size_t i = 0; i < array.values.size(); ++i) {
      largest = std::max(largest, std::abs(double(expected.values[i])));
      difference = std::max(difference, std::abs(double(array.values[i]) - expected.values[i]));
    }
    share = std::max(share, difference / largest);
  }
  return share;
}

void ByLibTorch(benchmark::State& state, const std::filesystem::path& weights) {
  const auto network = systems::LoadTrainingLibrary().open_network(weights, {});
  const NamedArrays inputs = InputsOf(runtime::ReadOnnx(weights / kWeightsGraph), state.range(0));
  network->Run(inputs);
  for (auto _ : state) benchmark::DoNotOptimize(network->Run(inputs));
}

void ByRuntime(benchmark::State& state, const std::filesystem::path& weights) {
  const runtime::Graph graph = runtime::ReadOnnx(weights / kWeightsGraph);
  const runtime::GraphRunner runner(graph);
  const NamedArrays inputs = InputsOf(graph, state.range(0));
  const NamedArrays outputs = runner.Run(inputs);
  for (auto _ : state) benchmark::DoNotOptimize(runner.Run(inputs));
  state.counters["difference"] =
      Difference(outputs, systems::LoadTrainingLibrary().open_network(weights, {})->Run(inputs));
  state.counters["arena_MB"] = double(runner.BytesFor(inputs)) / 1e6;
}

void Plan(benchmark::State& state, const std::filesystem::path& weights) {
  const runtime::Graph graph = runtime::ReadOnnx(weights / kWeightsGraph);
  const NamedArrays inputs = InputsOf(graph, state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(runtime::GraphRunner(graph).Run(inputs));
}

/// Once for each network.
const bool registered = [] {
  SetUpRuntime(0);
  const std::vector<std::filesystem::path> places = systems::WeightsPlaces();
  for (const systems::ShippedWeights& weights : systems::ListWeights(places)) {
    if (!std::filesystem::exists(weights.directory / kWeightsGraph)) continue;
    const auto add = [&](const char* what, void (*run)(benchmark::State&, const std::filesystem::path&)) {
      auto* const made =
          benchmark::RegisterBenchmark(fmt::format("{}/{}", weights.name(), what).c_str(), run, weights.directory);
      made->ArgName("batch")->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();
      return made;
    };
    add("LibTorch", ByLibTorch)->Arg(2)->Arg(7);
    add("Runtime", ByRuntime)->Arg(2)->Arg(7);
    add("Plan", Plan);
  }
  return true;
}();

}  // namespace
}  // namespace daumier
