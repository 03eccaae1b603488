#include "systems/deform/train/export.h"

#include "export/model_card.h"
#include "export/run_export.h"
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

Json ExportDeformRun(const fs::path& run_directory, const fs::path& out_directory) {
  const DeformRun run = LoadDeformRun(run_directory);
  return exporting::WriteExport(
      {.run_directory = run_directory,
       .run_manifest = run.manifest,
       .module = *run.network,
       .function = DeformFunction(run.network),
       .face_template = run.face_template,
       .counts = {{"vertices", run.network->num_vertices()}, {"parameters", run.network->num_parameters()}},
       .details = {{"model_from_cm", faces::ModelFrameToJson(run.network->frame())}},
       .write_rest =
           [&](const fs::path& folder) {
             const torch::Tensor& vertices = run.network->template_vertices();
             return std::map<std::string, std::string>{
                 {kPointsTemplate, tensor::SaveTensors(folder / kPointsTemplate, {{"vertices", vertices}})}};
           },
       .model_card = [&](const exporting::ParityReport& parity,
                         const std::optional<Json>& metrics) { return exporting::ModelCard(run, parity, metrics); }},
      out_directory);
}

}  // namespace daumier::deform
