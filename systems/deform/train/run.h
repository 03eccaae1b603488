#pragma once
#include "core/json.h"
#include "core/manifest.h"
#include "faces/face_model.h"
#include "systems/deform/train/network.h"

#include <filesystem>
#include <memory>
#include <string>

namespace daumier::deform {

/// What Manifest::details.product of a run folder calls it; a manifest without that entry is of a sketch run.
inline constexpr const char* kDeformProduct = "deform";
std::string ProductOf(const Manifest& run);

/// A deformable model with the codes of the faces that it was trained on: what best/ of a run holds.
class AutoDecoder : public torch::nn::Module {
 public:
  /// Codes are drawn from N(0, 0.01^2) by LibTorch's CPU generator [Jung et al. 2022, section 3.3].
  AutoDecoder(std::shared_ptr<DeformNetwork> network, int64_t num_codes);

  const std::shared_ptr<DeformNetwork>& network() const { return network_; }
  /// (num_codes, M), in the order of the run's training faces.
  const torch::Tensor& codes() const { return codes_; }

 private:
  std::shared_ptr<DeformNetwork> network_;
  torch::Tensor codes_;
};

/// A run folder of a deformable model read back:
///   manifest.json (kind "run", details.product "deform", details.split = SplitToJson, details.training_faces),
///   resolved.toml (tables `network` = DeformOptions and `loss`; the data paths), template.{safetensors,json},
///   best/model.safetensors (weights, template_vertices, model_from_cm, codes), checkpoints/latest/
struct DeformRun {
  std::filesystem::path directory;
  Manifest manifest;
  Json config;  ///< resolved.toml
  faces::FaceTemplate face_template;
  std::shared_ptr<DeformNetwork> network;   ///< In evaluation mode, on the CPU, weights of best/.
  torch::Tensor codes;                      ///< (training faces, M)
  double data_weight = 0, code_weight = 0;  ///< Of the energy that codes minimise: `loss` of the config.
};

/// @throws Error naming file and cause, and what to run, if the folder is not a finished run of a deformable model: no
/// manifest of kind "run", another product, no best weights, a file that is missing or differs from its checksum, or
/// weights of another network.
DeformRun LoadDeformRun(const std::filesystem::path& directory);

}  // namespace daumier::deform
