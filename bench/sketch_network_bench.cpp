// The networks of the table side by side: a training step of 32 sketches through the vertex loss in both precisions,
// and 1 or 32 sketches to vertices, by LibTorch and, exported, by ONNX Runtime (the median of 21 runs). Heads as
// large as ICT's; "full" is the printed network at 256 x 256, the others are those of configs/sketch/.
#include "core/files.h"
#include "export/onnx_export.h"
#include "export/onnx_runtime.h"
#include "losses/vertex_loss.h"
#include "systems/sketch/train/export.h"
#include "systems/sketch/train/network.h"
#include "tensor/autocast.h"
#include "tensor/runtime.h"
#include "tests/support/random_bilinear.h"
#include "tests/support/temp_dir.h"

#include <benchmark/benchmark.h>
#include <torch/optim.h>
#include <torch/utils.h>

#include <map>

namespace daumier {
namespace {

constexpr int kNumVertices = 10350;

sketch::SketchNetworkOptions Half(const std::string& trunk, const std::string& shape_input = "none") {
  return {.trunk = trunk,
          .shape_input = shape_input,
          .resolution = 128,
          .width = 48,
          .hidden = 2048,
          .branch = 512,
          .identity_layers = 3,
          .expression_layers = 1,
          .shape_hidden = 256};
}

std::map<std::string, sketch::SketchNetworkOptions> Networks() {
  sketch::SketchNetworkOptions full = Half("alexnet", "late");
  full.resolution = 256, full.width = 96, full.hidden = 4096, full.branch = 1024, full.shape_hidden = 512;
  full.batch_norm = false;
  const sketch::SketchNetworkOptions residual{.trunk = "residual",
                                              .resolution = 128,
                                              .width = 32,
                                              .hidden = 256,
                                              .branch = 256,
                                              .identity_layers = 1,
                                              .expression_layers = 1,
                                              .residual = 40};
  sketch::SketchNetworkOptions points = residual;
  points.trunk = "points", points.hidden = 512, points.residual = 0;
  return {{"full", full},
          {"PixelShapeCNN", Half("alexnet", "late")},
          {"PixelCNN", Half("alexnet")},
          {"ShapeNN", Half("shape")},
          {"residual", residual},
          {"points", points},
          {"demo", {}}};
}

sketch::SketchNetwork MakeNetwork(const sketch::SketchNetworkOptions& options) {
  torch::manual_seed(1);
  sketch::FittedModels models{
      testing::RandomBilinear(kNumVertices, 50, 16, 1), testing::RandomBilinear(200, 50, 16, 2), {}};
  if (options.residual > 0) {
    models.basis.rows = models.bilinear.core.topRows(options.residual);
    models.basis.deviation = Eigen::VectorXf::Ones(options.residual);
  }
  return sketch::SketchNetwork(options, models);
}

sketch::SketchInput MakeInput(const sketch::SketchNetwork& network, int64_t batch) {
  const int64_t side = network->options().resolution;
  const auto layout = torch::dtype(torch::kFloat32).memory_format(torch::MemoryFormat::ChannelsLast);
  return {torch::empty({batch, 1, side, side}, layout).copy_(torch::rand({batch, 1, side, side}) < 0.05),
          2 * torch::rand({batch, 4, network->options().num_points}) - 1,
          network->ShapeOf(torch::randn({batch, network->num_shape()}))};
}

void TrainingStep(benchmark::State& state, const sketch::SketchNetworkOptions& options, bool bfloat16) {
  auto network = MakeNetwork(options);
  const int64_t batch = 32;
  const sketch::SketchInput input = MakeInput(network, batch);
  const losses::GramVertexLoss loss(network->basis(), torch::ones({kNumVertices}));
  const auto moments = loss.Moments(torch::randn({batch, 3 * kNumVertices}));
  torch::optim::Adam adam(network->parameters());
  for (auto _ : state) {
    adam.zero_grad();
    sketch::SketchNetworkImpl::BranchFeatures features;
    {
      const tensor::Autocast precision(torch::kCPU, bfloat16);
      features = network->Features(input);
    }
    features = {features.identity.to(torch::kFloat32), features.expression.to(torch::kFloat32)};
    loss(network->Linear(network->Predict(features)), moments).backward();
    adam.step();
  }
  state.counters["sketches"] = benchmark::Counter(batch, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["parameters"] = double(network->num_parameters());
}

void Inference(benchmark::State& state, const sketch::SketchNetworkOptions& options) {
  auto network = MakeNetwork(options);
  network->eval();
  const at::NoGradGuard no_grad;
  const sketch::SketchInput input = MakeInput(network, state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(network->Decode(network->forward(input)));
}

void InferenceInOnnxRuntime(benchmark::State& state, const sketch::SketchNetworkOptions& options) {
  auto network = MakeNetwork(options);
  network->eval();
  const exporting::ExportedFunction function = sketch::SketchFunction(network);
  const testing::TempDir folder;
  WriteFileAtomically(folder / "model.onnx", exporting::ExportToOnnx(*network, function).SerializeAsString());
  Rng rng(1);
  tensor::NamedTensors inputs;
  for (const auto& input : function.inputs) inputs[input.name] = input.sample(state.range(0), rng);
  const auto result = exporting::RunInOnnxRuntime(folder / "model.onnx", {inputs}, function.output_names, folder.path(),
                                                  /*timed_runs=*/21);
  if (!result) return state.SkipWithError("there is no ONNX Runtime here: run ./dev setup");
  for (auto _ : state) state.SetIterationTime(result->milliseconds.front() / 1000);
  state.SetLabel(result->runtime);
}

/// Once for each network.
const bool registered = [] {
  tensor::SetUpTorch();
  for (const auto& [name, options] : Networks()) {
    for (const bool bfloat16 : {false, true}) {
      benchmark::RegisterBenchmark(("TrainingStep/" + name + (bfloat16 ? "/bfloat16" : "/float32")).c_str(),
                                   TrainingStep, options, bfloat16)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    }
    benchmark::RegisterBenchmark(("Inference/" + name).c_str(), Inference, options)
        ->ArgName("batch")
        ->Arg(1)
        ->Arg(32)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
    benchmark::RegisterBenchmark(("OnnxRuntime/" + name).c_str(), InferenceInOnnxRuntime, options)
        ->ArgName("batch")
        ->Arg(1)
        ->Arg(32)
        ->Unit(benchmark::kMillisecond)
        ->UseManualTime()
        ->Iterations(1);
  }
  return true;
}();

}  // namespace
}  // namespace daumier
