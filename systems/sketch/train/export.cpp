#include "systems/sketch/train/export.h"

#include "export/model_card.h"
#include "export/run_export.h"
#include "systems/sketch/train/run.h"

#include <algorithm>

namespace daumier::sketch {
namespace {

namespace fs = std::filesystem;

constexpr double kInkShare = 0.1;

torch::Tensor Filled(const std::vector<int64_t>& shape, const std::function<double()>& draw) {
  auto tensor = torch::empty(shape, torch::kFloat32);
  float* numbers = tensor.data_ptr<float>();
  std::generate(numbers, numbers + tensor.numel(), [&] { return static_cast<float>(draw()); });
  return tensor;
}

}  // namespace

exporting::ExportedFunction SketchFunction(SketchNetwork network) {
  const SketchNetworkOptions& options = network->options();
  const int64_t num_vertices = network->num_vertices();
  exporting::ExportedFunction function{"sketch", {}, {"u", "v"}, {}};
  if (options.reads_image()) {
    function.inputs.push_back(
        {"sketch", {1, options.resolution, options.resolution}, [&options](int64_t batch, Rng& rng) {
           return Filled({batch, 1, options.resolution, options.resolution},
                         [&] { return rng.Uniform() < kInkShare ? 1.0 : 0.0; });
         }});
  }
  if (options.reads_points()) {
    function.inputs.push_back({"points", {4, options.num_points}, [&options](int64_t batch, Rng& rng) {
                                 return Filled({batch, 4, options.num_points}, [&] { return rng.Uniform(-1, 1); });
                               }});
  }
  if (options.reads_shape()) {
    function.inputs.push_back(
        {"shape", {network->num_shape()}, [network](int64_t batch, Rng& rng) {
           return network->ShapeOf(Filled({batch, network->num_shape()}, [&] { return rng.Normal(); }));
         }});
  }
  if (options.residual > 0) function.output_names.push_back("residual");
  function.output_names.push_back("vertices");
  function.forward = [network, num_vertices](const std::vector<torch::Tensor>& inputs) mutable {
    const SketchNetworkOptions& read = network->options();
    SketchInput input;
    size_t next = 0;
    if (read.reads_image()) input.images = inputs[next++];
    if (read.reads_points()) input.points = inputs[next++];
    if (read.reads_shape()) input.shape = inputs[next++];
    const auto coefficients = network->forward(input);
    std::vector<torch::Tensor> outputs{coefficients.u, coefficients.v};
    if (read.residual > 0) outputs.push_back(coefficients.residual);
    outputs.push_back(network->Decode(coefficients).reshape({-1, num_vertices, 3}));
    return outputs;
  };
  return function;
}

Json ExportSketchRun(const fs::path& run_directory, const fs::path& out_directory) {
  const auto run = LoadSketchRun(run_directory);
  return exporting::WriteExport(
      {.run_directory = run_directory,
       .run_manifest = run.manifest,
       .module = *run.network,
       .function = SketchFunction(run.network),
       .face_template = run.face_template,
       .counts = {{"vertices", run.network->num_vertices()}, {"parameters", run.network->num_parameters()}},
       .model_card = [&](const exporting::ParityReport& parity,
                         const std::optional<Json>& metrics) { return exporting::ModelCard(run, parity, metrics); }},
      out_directory);
}

}  // namespace daumier::sketch
