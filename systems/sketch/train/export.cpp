#include "systems/sketch/train/export.h"

#include "export/onnx_graph.h"
#include "faces/face_database.h"
#include "systems/sketch/sketch_weights.h"
#include "systems/sketch/train/run.h"

#include <algorithm>
#include <memory>

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

std::string InputsAndOutputs(const SketchNetworkImpl& network) {
  const auto& options = network.options();
  std::string text = "| name | shape | meaning |\n|---|---|---|\n";
  if (options.reads_image()) {
    text += fmt::format(
        "| `sketch` | ({0}, 1, {1}, {1}) float32 | frontal line drawing; ink 1, paper 0; row 0 on top; the face "
        "upright "
        "and centred as in the training sketches |\n",
        exporting::kBatchDimension, options.resolution);
  }
  if (options.reads_points()) {
    text += fmt::format(
        "| `points` | ({}, 4, {}) float32 | points at equal distances along all strokes: x to the right and y down "
        "from "
        "-1 to 1 over the canvas, cosine and sine of twice the stroke's angle |\n",
        exporting::kBatchDimension, options.num_points);
  }
  if (options.reads_shape()) {
    text += fmt::format(
        "| `shape` | ({}, {}) float32 | u and v of the 2-D model of feature curves (`curves.safetensors` of the run) "
        "that "
        "explain the drawing |\n",
        exporting::kBatchDimension, network.num_shape());
  }
  text += fmt::format(
      "| `u` | ({0}, {1}) float32 | identity weights of the bilinear face model |\n"
      "| `v` | ({0}, {2}) float32 | expression weights of the bilinear face model |\n",
      exporting::kBatchDimension, network.num_identity(), network.num_expression());
  if (options.residual > 0) {
    text += fmt::format("| `residual` | ({}, {}) float32 | what is added to the bilinear face, in the linear basis |\n",
                        exporting::kBatchDimension, options.residual);
  }
  return text + fmt::format(
                    "| `vertices` | ({0}, {1}, 3) float32 | the face in centimetres: x to its own left, y up, z to the "
                    "front; order and triangles in `template.safetensors` |\n\n"
                    "{0} is any batch size. `vertices` is the bilinear face of `u` and `v`{2}.\n\n",
                    exporting::kBatchDimension, network.num_vertices(),
                    options.residual > 0 ? ", plus the residual" : "");
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

exporting::NetworkFunction MakeSketchFunction(const Json& network) {
  const SketchNetworkOfWeights made = SketchNetworkFromJson(network);
  const SketchNetwork module(made.options, made.sizes);
  return {module.ptr(), SketchFunction(module)};
}

exporting::RunExport DescribeSketchExport(const fs::path& run_directory) {
  const SketchRun run = LoadSketchRun(run_directory);
  const faces::FaceTemplate& face_template = run.face_template;
  return {
      .run_directory = run_directory,
      .run_manifest = run.manifest,
      .module = run.network.ptr(),
      .function = SketchFunction(run.network),
      .card = {.title = "Sketch to 3D face",
               .summary = fmt::format(
                   "A network with {} trained parameters that turns a line drawing of a face into a 3D face of the "
                   "'{}' topology, after DeepSketch2Face (Han et al., SIGGRAPH 2017), trained and exported by "
                   "Daumier.",
                   run.network->num_parameters(), face_template.source),
               .inputs_and_outputs = InputsAndOutputs(*run.network),
               .limits = {"It was trained on drawings made by rendering feature curves of synthetic faces, not on "
                          "drawings by people; lines that those drawings lack (hair, shading, glasses) mislead it.",
                          "It returns a face of its bilinear model for any input, and gives no confidence.",
                          "Depth is estimated from a frontal drawing by what is usual in the training faces.",
                          "It is a tool for drawing. It must not be used to identify or to judge people."}},
      .counts = {{"vertices", run.network->num_vertices()}, {"parameters", run.network->num_parameters()}},
      .write_rest = [face_template](const fs::path& folder) { return faces::WriteFaceTemplate(folder, face_template); },
      .for_weights =
          exporting::RunExport::ForWeights{.network = NetworkToJson({run.network_options, SizesOf(run.models)}),
                                           .write_rest = [folder = std::make_shared<const SketchRunFolder>(run)](
                                                             const fs::path&, const fs::path& neighbours) {
                                             return WriteSketchWeights(*folder, neighbours);
                                           }}};
}

}  // namespace daumier::sketch
