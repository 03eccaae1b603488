#include "systems/portrait/train/portrait_network.h"

#include "tensor/eigen.h"

namespace daumier::portrait {

PortraitNetworkImpl::PortraitNetworkImpl(const PortraitNetworkOptions& options,
                                         faces::ExpressionWeights expression_weights,
                                         const fitting::PortraitPose& usual_pose)
    : options_(options), expression_weights_(expression_weights) {
  usual_pose_ = register_buffer("usual_pose", tensor::CopyToTensor(usual_pose.cast<float>()));
  network_ = register_module(
      "network", models::ResidualNetwork(models::ResidualNetworkOptions{.depth = options.depth,
                                                                        .resolution = options.resolution,
                                                                        .width = options.width,
                                                                        .outputs = faces::kNumCoefficients}));
}

torch::Tensor PortraitNetworkImpl::forward(const torch::Tensor& crops) {
  return models::CoefficientsOf(network_->forward(crops), expression_weights_, usual_pose_);
}

}  // namespace daumier::portrait
