#pragma once
#include "systems/deform/run_folder.h"
#include "systems/deform/train/network.h"

#include <memory>

namespace daumier::deform {

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

/// A run folder with its network and codes, as evaluation and export use it.
struct DeformRun : DeformRunFolder {
  std::shared_ptr<DeformNetwork> network;  ///< In evaluation mode, on the CPU, weights of best/, without gradients.
  torch::Tensor codes;                     ///< (training faces, M)
};

/// @throws Error as ReadDeformRunFolder, or if the weights are of another network.
DeformRun LoadDeformRun(const std::filesystem::path& directory);

}  // namespace daumier::deform
