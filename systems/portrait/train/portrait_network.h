#pragma once
#include "models/coefficient_map.h"
#include "models/residual_network.h"
#include "systems/portrait/portrait_network_options.h"

namespace daumier::portrait {

/// A residual network from crops (B, 3, R, R), colours 0 .. 1, to the coefficients of portraits (B, 239). At first
/// every crop has those of the mean face in its usual pose.
class PortraitNetworkImpl : public torch::nn::Module {
 public:
  /// @throws Error as models::ResidualNetworkImpl.
  PortraitNetworkImpl(const PortraitNetworkOptions& options, faces::ExpressionWeights expression_weights);

  torch::Tensor forward(const torch::Tensor& crops);

  const PortraitNetworkOptions& options() const { return options_; }
  const models::CoefficientMap& map() const { return map_; }
  int64_t num_parameters() const { return network_->num_parameters(); }

 private:
  const PortraitNetworkOptions options_;
  const models::CoefficientMap map_;
  models::ResidualNetwork network_{nullptr};
};
TORCH_MODULE(PortraitNetwork);

}  // namespace daumier::portrait
