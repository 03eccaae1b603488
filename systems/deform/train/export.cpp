#include "systems/deform/train/export.h"

#include "export/onnx_graph.h"
#include "faces/face_database.h"
#include "systems/deform/train/run.h"
#include "tensor/tensor_file.h"

namespace daumier::deform {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPointsTemplate = "points_template.safetensors";
/// About as codes of faces are.
constexpr double kCodeDeviation = 0.01;

torch::Tensor DrawCodes(int64_t count, int64_t latent, Rng& rng) {
  torch::Tensor codes = torch::empty({count, latent});
  float* const numbers = codes.data_ptr<float>();
  for (int64_t i = 0; i < codes.numel(); ++i) numbers[i] = float(kCodeDeviation * rng.Normal());
  return codes;
}

/// Vertices of the template, drawn at random.
torch::Tensor DrawPoints(const torch::Tensor& vertices, int64_t count, Rng& rng) {
  std::vector<int64_t> chosen;
  for (int64_t i = 0; i < count; ++i) chosen.push_back(int64_t(rng.Below(uint64_t(vertices.size(0)))));
  return vertices.index_select(0, torch::tensor(chosen, torch::kInt64));
}

std::string InputsAndOutputs(const DeformRun& run) {
  const DeformNetwork& network = *run.network;
  const faces::ModelFrame frame = network.frame();
  std::string text = "| name | shape | meaning |\n|---|---|---|\n";
  const int latent = network.options().latent;
  if (network.options().is_array()) {
    text += fmt::format(
        "| `latent` | ({0}, {1}) float32 | codes |\n"
        "| `vertices` | ({0}, {2}, 3) float32 | where the vertices go, in model units |\n\n{0} is any batch size. ",
        exporting::kBatchDimension, latent, network.num_vertices());
  } else {
    text += fmt::format(
        "| `latent` | (1, {1}) float32 | a code |\n"
        "| `points` | ({0}, 3) float32 | points on the template, in model units: its vertices are in "
        "`points_template.safetensors`, and any point between them is valid |\n"
        "| `positions` | ({0}, 3) float32 | where they go, in model units |\n\n{0} is any number of points. ",
        exporting::kBatchDimension, latent);
  }
  return text + fmt::format(
                    "A point of the faces in centimetres is p_model = {:.9g} p_cm + ({:.9g}, {:.9g}, {:.9g}); the "
                    "model's metadata `model_from_cm` holds the same. The code of zeros is about the mean face; codes "
                    "of training faces have numbers of about {:.2g}.\n\n",
                    frame.scale, frame.offset.x(), frame.offset.y(), frame.offset.z(),
                    run.codes.square().mean().sqrt().item<double>());
}

}  // namespace

exporting::ExportedFunction DeformFunction(std::shared_ptr<DeformNetwork> network) {
  const int64_t latent = network->options().latent;
  exporting::ExportedFunction function{
      "deform", {}, {}, {}, {{"model_from_cm", faces::ModelFrameToJson(network->frame()).dump()}}};
  if (network->options().is_array()) {
    function.inputs = {
        {"latent", {latent}, [latent](int64_t batch, Rng& rng) { return DrawCodes(batch, latent, rng); }}};
    function.output_names = {"vertices"};
    function.forward = [network](const std::vector<torch::Tensor>& inputs) {
      return std::vector<torch::Tensor>{network->DeformVertices(inputs[0])};
    };
  } else {
    function.inputs = {
        {"latent", {1, latent}, [latent](int64_t, Rng& rng) { return DrawCodes(1, latent, rng); }, /*batched=*/false},
        {"points", {3}, [network](int64_t batch, Rng& rng) {
           return DrawPoints(network->template_vertices(), batch, rng);
         }}};
    function.output_names = {"positions"};
    function.forward = [network](const std::vector<torch::Tensor>& inputs) {
      return std::vector<torch::Tensor>{network->Deform(inputs[0], {{}, {}, inputs[1]}).squeeze(0)};
    };
  }
  return function;
}

exporting::RunExport DescribeDeformExport(const fs::path& run_directory) {
  const DeformRun run = LoadDeformRun(run_directory);
  return {.run_directory = run_directory,
          .run_manifest = run.manifest,
          .module = run.network,
          .function = DeformFunction(run.network),
          .card = {.title = "Deformable 3D caricatures",
                   .summary = fmt::format(
                       "A model with {} parameters of kind '{}' that turns a code into a head of the '{}' topology, "
                       "after Deep Deformable 3D Caricatures (Jung et al., SIGGRAPH 2022), trained and exported by "
                       "Daumier.",
                       run.network->num_parameters(), run.network->options().kind, run.face_template.source),
                   .inputs_and_outputs = InputsAndOutputs(run),
                   .limits = {"It was trained on caricatures that a program made, not on artists' ones, unless a "
                              "source above is such a set.",
                              "Nothing keeps a surface from intersecting itself; strong codes do it around lips and "
                              "chin.",
                              "It must not be used to identify or to judge people."}},
          .counts = {{"vertices", run.network->num_vertices()}, {"parameters", run.network->num_parameters()}},
          .details = {{"model_from_cm", faces::ModelFrameToJson(run.network->frame())}},
          .write_rest = [network = run.network, face_template = run.face_template](const fs::path& folder) {
            auto checksums = faces::WriteFaceTemplate(folder, face_template);
            checksums[kPointsTemplate] =
                tensor::SaveTensors(folder / kPointsTemplate, {{"vertices", network->template_vertices()}});
            return checksums;
          }};
}

}  // namespace daumier::deform
