#pragma once
#include "fitting/portrait_view.h"
#include "models/coefficient_map.h"
#include "models/residual_network.h"
#include "systems/portrait/portrait_network_options.h"

namespace daumier::portrait {

/// A residual network from crops (B, 3, R, R), colours 0 .. 1, to the coefficients of portraits (B, 239). At first
/// every crop has those of the mean face in its usual pose.
class PortraitNetworkImpl : public torch::nn::Module {
 public:
  /// usual_pose: that of the mean face at first. It is kept among the weights, so that loading them replaces it.
  /// @throws Error as models::ResidualNetworkImpl.
  PortraitNetworkImpl(const PortraitNetworkOptions& options, faces::ExpressionWeights expression_weights,
                      const fitting::PortraitPose& usual_pose = fitting::PortraitPose::Zero());

  torch::Tensor forward(const torch::Tensor& crops);

  const PortraitNetworkOptions& options() const { return options_; }
  faces::ExpressionWeights expression_weights() const { return expression_weights_; }
  const torch::Tensor& usual_pose() const { return usual_pose_; }
  int64_t num_parameters() const { return network_->num_parameters(); }

 private:
  const PortraitNetworkOptions options_;
  const faces::ExpressionWeights expression_weights_;
  torch::Tensor usual_pose_;
  models::ResidualNetwork network_{nullptr};
};
TORCH_MODULE(PortraitNetwork);

}  // namespace daumier::portrait
