#include "systems/deform/train/run.h"

#include "core/config.h"
#include "core/error.h"
#include "core/run_manifest.h"
#include "faces/face_database.h"
#include "tensor/module_state.h"

namespace daumier::deform {

namespace fs = std::filesystem;

std::string ProductOf(const Manifest& run) {
  return run.details.value("product", "sketch");
}

AutoDecoder::AutoDecoder(std::shared_ptr<DeformNetwork> network, int64_t num_codes)
    : network_(register_module("network", std::move(network))) {
  constexpr double kDeviation = 0.01;
  codes_ = register_parameter("codes", kDeviation * torch::randn({num_codes, network_->options().latent}));
}

DeformRun LoadDeformRun(const fs::path& directory) {
  DeformRun run;
  run.directory = directory;
  DAUMIER_CHECK(fs::exists(directory / "manifest.json"),
                "{} is not a run folder (manifest.json is missing): make one with `daumier train CONFIG --out {}`",
                directory.string(), directory.string());
  run.manifest = ReadManifest(directory, "run");
  DAUMIER_CHECK(ProductOf(run.manifest) == kDeformProduct, "{} is a run of kind '{}', not of a deformable model",
                directory.string(), ProductOf(run.manifest));
  const fs::path config_file = ResolvedConfig(directory), weights_file = BestWeights(directory);
  DAUMIER_CHECK(fs::exists(weights_file),
                "{} has no best weights yet ({} is missing): go on training it with `daumier train --resume --out {}`",
                directory.string(), weights_file.string(), directory.string());
  VerifyChecksums(directory, run.manifest);
  run.config = LoadConfig(config_file);
  run.face_template = faces::ReadFaceTemplate(directory);
  try {
    run.data_weight = run.config.at("loss").at("data_weight").get<double>();
    run.code_weight = run.config.at("loss").at("code_weight").get<double>();
    const auto options = ParseOptions<DeformOptions>(run.config.at("network"), config_file.string());
    const auto num_codes = run.manifest.counts.at("training_faces").get<int64_t>();
    AutoDecoder decoder(
        MakeDeformNetwork(options, torch::zeros({run.face_template.num_vertices(), 3}), faces::ModelFrame{}),
        num_codes);
    tensor::LoadModule(weights_file, decoder);
    decoder.eval();
    run.network = decoder.network();
    run.codes = decoder.codes().detach();
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{} is malformed: {}", directory.string(), error.what()));
  }
  for (const torch::Tensor& parameter : run.network->parameters()) parameter.requires_grad_(false);
  return run;
}

}  // namespace daumier::deform
