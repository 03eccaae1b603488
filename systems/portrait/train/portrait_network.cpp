#include "systems/portrait/train/portrait_network.h"

namespace daumier::portrait {

PortraitNetworkImpl::PortraitNetworkImpl(const PortraitNetworkOptions& options,
                                         faces::ExpressionWeights expression_weights)
    : options_(options), map_{expression_weights, options.usual_depth} {
  network_ = register_module(
      "network", models::ResidualNetwork(models::ResidualNetworkOptions{.depth = options.depth,
                                                                        .resolution = options.resolution,
                                                                        .width = options.width,
                                                                        .outputs = faces::kNumCoefficients}));
}

torch::Tensor PortraitNetworkImpl::forward(const torch::Tensor& crops) {
  return models::CoefficientsOf(network_->forward(crops), map_);
}

}  // namespace daumier::portrait
