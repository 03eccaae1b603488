#include "models/sketch_network.h"

#include "core/error.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"

#include <algorithm>

namespace daumier::models {
namespace {

namespace nn = torch::nn;

constexpr int kLastSide = 4;
constexpr int kMaxWidening = 16;
/// Of a coefficient that hardly varies over the training faces, as a share of the largest: it may still move this much.
constexpr double kDeviationFloor = 1e-2;

struct Standardisation {
  torch::Tensor mean, deviation;
};

/// factors: N x K, a row an identity or expression of the training set.
Standardisation Standardise(const Eigen::MatrixXf& factors) {
  const auto rows = tensor::CopyToTensor(factors);
  const auto deviation = rows.std(0, /*unbiased=*/false);
  const auto floor = std::max(deviation.max().item<float>() * kDeviationFloor, 1e-6);
  return {rows.mean(0), deviation.clamp_min(floor)};
}

nn::Sequential Trunk(const PixelCnnOptions& options) {
  nn::Sequential trunk;
  int side = options.resolution, from = 1, to = options.width;
  while (side > kLastSide) {
    trunk->push_back(nn::Conv2d(nn::Conv2dOptions(from, to, 3).stride(2).padding(1).bias(false)));
    trunk->push_back(nn::BatchNorm2d(to));
    trunk->push_back(nn::ReLU());
    side = (side + 1) / 2;
    from = to;
    to = std::min(2 * to, kMaxWidening * options.width);
  }
  trunk->push_back(nn::Flatten());
  trunk->push_back(nn::Linear(from * side * side, options.hidden));
  trunk->push_back(nn::ReLU());
  return trunk;
}

}  // namespace

SketchNetworkImpl::SketchNetworkImpl(const PixelCnnOptions& options, const faces::BilinearModel& bilinear)
    : options_(options) {
  DAUMIER_CHECK(
      bilinear.core.rows() == bilinear.num_identity * bilinear.num_expression && bilinear.core.cols() % 3 == 0,
      "the core of the bilinear model is {} x {}, expected {} * {} rows and three columns a vertex",
      bilinear.core.rows(), bilinear.core.cols(), bilinear.num_identity, bilinear.num_expression);
  DAUMIER_CHECK(bilinear.identity_factors.cols() == bilinear.num_identity &&
                    bilinear.expression_factors.cols() == bilinear.num_expression,
                "the bilinear model has factors of {} and {} columns, expected {} and {}",
                bilinear.identity_factors.cols(), bilinear.expression_factors.cols(), bilinear.num_identity,
                bilinear.num_expression);
  trunk_ = register_module("trunk", Trunk(options));
  identity_branch_ = register_module("identity", nn::Sequential(nn::Linear(options.hidden, options.hidden), nn::ReLU(),
                                                                nn::Linear(options.hidden, options.hidden), nn::ReLU(),
                                                                nn::Linear(options.hidden, bilinear.num_identity)));
  expression_branch_ =
      register_module("expression", nn::Sequential(nn::Linear(options.hidden, bilinear.num_expression)));
  const Standardisation u = Standardise(bilinear.identity_factors);
  const Standardisation v = Standardise(bilinear.expression_factors);
  u_mean_ = register_buffer("u_mean", u.mean);
  u_deviation_ = register_buffer("u_deviation", u.deviation);
  v_mean_ = register_buffer("v_mean", v.mean);
  v_deviation_ = register_buffer("v_deviation", v.deviation);
  core_ = register_buffer("core", tensor::CopyToTensor(bilinear.core));
}

FaceCoefficients SketchNetworkImpl::forward(const torch::Tensor& images) {
  tensor::CheckShape(images, {tensor::kAny, 1, options_.resolution, options_.resolution}, "images");
  const auto features = trunk_->forward(images);
  return {u_mean_ + u_deviation_ * identity_branch_->forward(features),
          v_mean_ + v_deviation_ * expression_branch_->forward(features)};
}

torch::Tensor SketchNetworkImpl::Decode(const FaceCoefficients& coefficients) const {
  const auto& [u, v] = coefficients;
  tensor::CheckShape(u, {tensor::kAny, num_identity()}, "u");
  tensor::CheckShape(v, {u.size(0), num_expression()}, "v");
  return torch::mm((u.unsqueeze(2) * v.unsqueeze(1)).flatten(1), core_);
}

int64_t SketchNetworkImpl::num_parameters() const {
  int64_t count = 0;
  for (const auto& parameter : parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::models
