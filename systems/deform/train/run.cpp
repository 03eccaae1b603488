#include "systems/deform/train/run.h"

#include "core/error.h"
#include "core/run_manifest.h"
#include "tensor/module_state.h"

namespace daumier::deform {

namespace fs = std::filesystem;

AutoDecoder::AutoDecoder(std::shared_ptr<DeformNetwork> network, int64_t num_codes)
    : network_(register_module("network", std::move(network))) {
  constexpr double kDeviation = 0.01;
  codes_ = register_parameter("codes", kDeviation * torch::randn({num_codes, network_->options().latent}));
}

DeformRun LoadDeformRun(const fs::path& directory) {
  DeformRun run{ReadDeformRunFolder(directory), nullptr, {}};
  const auto counts = run.manifest.counts.find("training_faces");
  DAUMIER_CHECK(counts != run.manifest.counts.end() && counts->is_number_integer(),
                "{}: the manifest does not hold the number of training faces. Train again", directory.string());
  AutoDecoder decoder(MakeDeformNetwork(run.network_options, torch::zeros({run.face_template.num_vertices(), 3}),
                                        faces::ModelFrame{}),
                      counts->get<int64_t>());
  tensor::LoadModule(BestWeights(directory), decoder);
  decoder.eval();
  run.network = decoder.network();
  run.codes = decoder.codes().detach();
  for (const torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::deform
