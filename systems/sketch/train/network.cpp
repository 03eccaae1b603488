#include "systems/sketch/train/network.h"

#include "core/error.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"

#include <torch/nn/modules/activation.h>

#include <algorithm>

namespace daumier::sketch {
namespace {

namespace nn = torch::nn;

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

void Check(const faces::BilinearModel& model) {
  DAUMIER_CHECK(model.core.rows() == model.num_identity * model.num_expression,
                "the core of the bilinear model is {} x {}, expected {} * {} rows", model.core.rows(),
                model.core.cols(), model.num_identity, model.num_expression);
  DAUMIER_CHECK(
      model.identity_factors.cols() == model.num_identity && model.expression_factors.cols() == model.num_expression,
      "the bilinear model has factors of {} and {} columns, expected {} and {}", model.identity_factors.cols(),
      model.expression_factors.cols(), model.num_identity, model.num_expression);
}

/// `layers` fully connected ones of `width` neurons; returns the width of the output.
int64_t Stack(nn::Sequential& branch, int64_t from, int layers, int width) {
  for (int layer = 0; layer < layers; ++layer) {
    branch->push_back(nn::Linear(from, width));
    branch->push_back(nn::ReLU());
    from = width;
  }
  return from;
}

torch::Tensor Through(nn::Sequential& layers, const torch::Tensor& input) {
  return layers->is_empty() ? input : layers->forward(input);
}

}  // namespace

SketchNetworkImpl::SketchNetworkImpl(const SketchNetworkOptions& options, const SketchNetworkSizes& sizes)
    : options_(options) {
  DAUMIER_CHECK(options.trunk != "shape" || options.shape_input == "none",
                "network.trunk=\"shape\" reads the curve coefficients itself: network.shape_input has to be \"none\"");
  const bool early = options.shape_input == "early", late = options.shape_input == "late";
  trunk_ = models::MakeSketchTrunk(TrunkOf(options, sizes.num_shape));
  if (options.has_whole_blocks()) models::StoreChannelsLast(*trunk_.convolutions);
  register_module("convolutions", trunk_.convolutions);
  register_module("features", trunk_.features);

  const int64_t features = options.hidden + (early ? sizes.num_shape : 0);
  identity_branch_ = register_module("identity_branch", nn::Sequential());
  identity_width_ = Stack(identity_branch_, features, options.identity_layers, options.branch);
  const bool two = options.branches == "two";
  if (two) {
    expression_branch_ = register_module("expression_branch", nn::Sequential());
    expression_width_ = Stack(expression_branch_, features, options.expression_layers, options.branch);
  } else {
    expression_width_ = identity_width_;
  }
  if (late) {
    identity_shape_ = register_module("identity_shape", nn::Linear(sizes.num_shape, options.shape_hidden));
    identity_width_ += options.shape_hidden;
    if (two) expression_shape_ = register_module("expression_shape", nn::Linear(sizes.num_shape, options.shape_hidden));
    expression_width_ += options.shape_hidden;
  }
  identity_output_ = register_module("identity_output", nn::Linear(identity_width_, sizes.num_identity));
  expression_output_ = register_module("expression_output", nn::Linear(expression_width_, sizes.num_expression));
  if (options.residual > 0) {
    residual_output_ = register_module(
        "residual_output", nn::Linear(two ? identity_width_ + expression_width_ : identity_width_, options.residual));
  }
  RegisterBuffers(sizes);
}

void SketchNetworkImpl::RegisterBuffers(const SketchNetworkSizes& sizes) {
  const auto constant = [this](const char* name, std::vector<int64_t> shape, double value) {
    return register_buffer(name, torch::full(shape, value));
  };
  const int64_t products = int64_t(sizes.num_identity) * sizes.num_expression, residual = options_.residual;
  u_mean_ = constant("u_mean", {sizes.num_identity}, 0);
  u_deviation_ = constant("u_deviation", {sizes.num_identity}, 1);
  v_mean_ = constant("v_mean", {sizes.num_expression}, 0);
  v_deviation_ = constant("v_deviation", {sizes.num_expression}, 1);
  shape_mean_ = constant("shape_mean", {sizes.num_shape}, 0);
  shape_deviation_ = constant("shape_deviation", {sizes.num_shape}, 1);
  if (residual > 0) {
    residual_deviation_ = constant("residual_deviation", {residual}, 1);
    products_ = constant("products", {products, residual}, 0);
  }
  basis_ = constant("basis", {residual > 0 ? residual : products, 3 * int64_t(sizes.num_vertices)}, 0);
}

SketchNetworkImpl::SketchNetworkImpl(const SketchNetworkOptions& options, const FittedModels& models)
    : SketchNetworkImpl(options, SizesOf(models)) {
  const faces::BilinearModel& bilinear = models.bilinear;
  DAUMIER_CHECK(models.basis.size() == options.residual &&
                    (options.residual == 0 || (models.basis.rows.cols() == bilinear.core.cols() &&
                                               models.basis.deviation.size() == options.residual)),
                "the basis is {} x {}, expected {} x {}", models.basis.rows.rows(), models.basis.rows.cols(),
                options.residual, bilinear.core.cols());
  const Standardisation u = Standardise(bilinear.identity_factors), v = Standardise(bilinear.expression_factors),
                        shape_u = Standardise(models.curves.identity_factors),
                        shape_v = Standardise(models.curves.expression_factors);
  const at::NoGradGuard no_grad;
  u_mean_.copy_(u.mean);
  u_deviation_.copy_(u.deviation);
  v_mean_.copy_(v.mean);
  v_deviation_.copy_(v.deviation);
  shape_mean_.copy_(torch::cat({shape_u.mean, shape_v.mean}));
  shape_deviation_.copy_(torch::cat({shape_u.deviation, shape_v.deviation}));
  if (options.residual == 0) {
    basis_.copy_(tensor::CopyToTensor(bilinear.core));
    return;
  }
  residual_deviation_.copy_(tensor::CopyToTensor(models.basis.deviation));
  products_.copy_(tensor::CopyToTensor(bilinear.core * models.basis.rows.transpose()));
  basis_.copy_(tensor::CopyToTensor(models.basis.rows));
}

SketchNetworkSizes SizesOf(const FittedModels& models) {
  Check(models.bilinear);
  Check(models.curves);
  DAUMIER_CHECK(models.bilinear.core.cols() % 3 == 0, "the bilinear model has {} coordinates, expected three a vertex",
                models.bilinear.core.cols());
  return {models.bilinear.num_identity, models.bilinear.num_expression,
          models.curves.num_identity + models.curves.num_expression, int(models.bilinear.core.cols() / 3)};
}

models::TrunkOptions TrunkOf(const SketchNetworkOptions& options, int num_shape) {
  return {options.trunk, options.resolution, options.width, options.batch_norm, options.hidden, num_shape};
}

torch::Tensor ChannelsLast(const torch::Tensor& images) {
  if (!images.defined()) return images;
  const int64_t height = images.size(2), width = images.size(3);
  return images.contiguous().as_strided(images.sizes(), {height * width, 1, width, 1});
}

SketchNetworkImpl::BranchFeatures SketchNetworkImpl::Features(const SketchInput& input) {
  torch::Tensor shape, features;
  if (options_.reads_shape()) {
    tensor::CheckShape(input.shape, {tensor::kAny, num_shape()}, "shape");
    shape = (input.shape - shape_mean_) / shape_deviation_;
  }
  if (options_.reads_image()) {
    tensor::CheckShape(input.images, {tensor::kAny, 1, options_.resolution, options_.resolution}, "images");
    features =
        trunk_.convolutions->forward(options_.has_whole_blocks() ? input.images : models::InPlainLayout(input.images));
  } else if (options_.reads_points()) {
    tensor::CheckShape(input.points, {tensor::kAny, 4, options_.num_points}, "points");
    features = trunk_.convolutions->forward(input.points);
  } else {
    features = shape;
  }
  features = trunk_.features->forward(features);
  if (options_.shape_input == "early") features = torch::cat({features, shape}, 1);

  BranchFeatures last;
  last.identity = Through(identity_branch_, features);
  if (identity_shape_) last.identity = torch::cat({last.identity, torch::relu(identity_shape_->forward(shape))}, 1);
  if (!expression_branch_) return {last.identity, last.identity};
  last.expression = Through(expression_branch_, features);
  if (expression_shape_)
    last.expression = torch::cat({last.expression, torch::relu(expression_shape_->forward(shape))}, 1);
  return last;
}

FaceCoefficients SketchNetworkImpl::Predict(const BranchFeatures& features) {
  FaceCoefficients result{u_mean_ + u_deviation_ * identity_output_->forward(features.identity),
                          v_mean_ + v_deviation_ * expression_output_->forward(features.expression),
                          {}};
  if (residual_output_) {
    const torch::Tensor both =
        expression_branch_ ? torch::cat({features.identity, features.expression}, 1) : features.identity;
    result.residual = residual_deviation_ * residual_output_->forward(both);
  }
  return result;
}

torch::Tensor SketchNetworkImpl::Linear(const FaceCoefficients& coefficients) const {
  const auto& [u, v, residual] = coefficients;
  tensor::CheckShape(u, {tensor::kAny, num_identity()}, "u");
  tensor::CheckShape(v, {u.size(0), num_expression()}, "v");
  const torch::Tensor products = (u.unsqueeze(2) * v.unsqueeze(1)).flatten(1);
  if (options_.residual == 0) return products;
  tensor::CheckShape(residual, {u.size(0), options_.residual}, "residual");
  return torch::mm(products, products_) + residual;
}

void SketchNetworkImpl::FreezeConvolutions(bool frozen) {
  frozen_ = frozen;
  for (auto& parameter : trunk_.convolutions->parameters()) parameter.set_requires_grad(!frozen);
  train(is_training());
}

void SketchNetworkImpl::train(bool on) {
  Module::train(on);
  trunk_.convolutions->train(on && !frozen_);
}

FaceCoefficients SketchNetworkImpl::Standardised(const FaceCoefficients& coefficients) const {
  return {(coefficients.u - u_mean_) / u_deviation_, (coefficients.v - v_mean_) / v_deviation_, {}};
}

int64_t SketchNetworkImpl::num_parameters() const {
  int64_t count = 0;
  for (const auto& parameter : parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::sketch
