#include "systems/portrait/train/portrait_export.h"

#include "export/onnx_graph.h"
#include "systems/portrait/portrait_weights.h"
#include "systems/portrait/train/export_samples.h"
#include "systems/portrait/train/portrait_run.h"

#include <memory>

namespace daumier::portrait {
namespace {

namespace fs = std::filesystem;

torch::Tensor DrawPortraitCrops(int64_t batch, int64_t resolution, Rng& rng) {
  torch::Tensor crops = torch::empty({batch, 3, resolution, resolution});
  float* const numbers = crops.data_ptr<float>();
  for (int64_t i = 0; i < crops.numel(); ++i) numbers[i] = float(rng.Uniform());
  return crops;
}

std::string PortraitInputsAndOutputs(const PortraitRun& run) {
  const PortraitPictureOptions& pictures = run.options.pictures;
  std::string place = "the whole picture, its longer side as long as the crop's";
  if (pictures.crop == "landmarks")
    place = fmt::format(
        "the box of the 68 landmarks has a longer side of {:g} times the crop's and its centre at (0.5, 0.55) of it",
        pictures.size);
  return fmt::format(
      "| name | shape | meaning |\n|---|---|---|\n"
      "| `crop` | ({0}, 3, {1}, {1}) float32 | RGB, 0 .. 1, row 0 on top: {2} |\n"
      "| `coefficients` | ({0}, {3}) float32 | identity {4}, expression {5}, albedo {6} of the 3DMM in "
      "`morphable.safetensors`; light: 9 spherical harmonics, of whose first number 0.8 are left out; pose: pitch, "
      "yaw, "
      "roll in radians, translation in cm |\n\n"
      "{0} is any batch size. With R = Rz(roll) Ry(yaw) Rx(pitch) and q = R p + t a vertex p is at x = 112 + 1015 q_x "
      "/ "
      "(100 - q_z), y = 112 - 1015 q_y / (100 - q_z) of a crop of 224 x 224.\n\n",
      exporting::kBatchDimension, run.options.network.resolution, place, faces::kNumCoefficients,
      faces::kIdentitySlot.count, faces::kExpressionSlot.count, faces::kAlbedoSlot.count);
}

}  // namespace

exporting::ExportedFunction PortraitFunction(PortraitNetwork network) {
  const int64_t resolution = network->options().resolution;
  exporting::ExportedFunction function{"portrait", {}, {"coefficients"}, {}};
  function.inputs = {{"crop", {3, resolution, resolution}, [resolution](int64_t batch, Rng& rng) {
                        return DrawPortraitCrops(batch, resolution, rng);
                      }}};
  function.forward = [network](const std::vector<torch::Tensor>& inputs) mutable {
    return std::vector<torch::Tensor>{
        models::ClampedExpressions(network->forward(inputs[0]), network->expression_weights())};
  };
  return function;
}

exporting::NetworkFunction MakePortraitNetwork(const Json& network) {
  const PortraitNetworkOfWeights made = PortraitNetworkFromJson(network);
  const PortraitNetwork module(made.options, made.expression_weights);
  return {module.ptr(), PortraitFunction(module)};
}

exporting::RunExport DescribePortraitExport(const fs::path& run_directory) {
  const PortraitRun run = LoadPortraitRun(run_directory);
  const auto folder = std::make_shared<const PortraitRunFolder>(run);
  return {
      .run_directory = run_directory,
      .run_manifest = run.manifest,
      .module = run.network.ptr(),
      .function = PortraitFunction(run.network),
      .card = {.title = "Portrait to 3D face",
               .summary = fmt::format(
                   "A residual network with {} parameters that turns a portrait into the coefficients of a 3D "
                   "morphable model of the '{}' topology, after the coarse stage of Generating animatable 3D "
                   "cartoon faces from single portraits (Pan et al., 2024), trained and exported by Daumier.",
                   run.network->num_parameters(), run.model.face_template.source),
               .inputs_and_outputs = PortraitInputsAndOutputs(run),
               .limits = {"It was trained on portraits that a program drew: pictures by people differ.",
                          "Its 3DMM has no surface for eyeballs, teeth and hair.",
                          "It must not be used to identify or to judge people."}},
      .counts = {{"vertices", run.model.face_template.num_vertices()}, {"parameters", run.network->num_parameters()}},
      .write_rest = [folder](const fs::path& out) { return faces::WriteMorphableFiles(out, folder->model); },
      .for_weights = exporting::RunExport::ForWeights{.network = NetworkToJson(
                                                          {run.options.network, run.model.expression_weights}),
                                                      .write_rest =
                                                          [folder](const fs::path& out, const fs::path& neighbours) {
                                                            return WritePortraitWeights(*folder, out, neighbours);
                                                          }},
      .find_samples = [folder](exporting::ExportedFunction& function) { SamplePortraitCrops(*folder, function); }};
}

}  // namespace daumier::portrait
