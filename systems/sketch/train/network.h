#pragma once
#include "models/sketch_trunks.h"
#include "systems/sketch/fitted_models.h"
#include "systems/sketch/network_options.h"

#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/pimpl.h>

namespace daumier::sketch {

/// Input of a network for B sketches; arrays that its options do not use may be undefined.
struct SketchInput {
  torch::Tensor images;  ///< (B, 1, R, R), ink = 1, paper = 0.
  torch::Tensor points;  ///< (B, 4, P), as datasets::SketchDataset reads them.
  torch::Tensor shape;   ///< (B, S), the curve coefficients, u and v of the 2-D curve model, in its own units.

  int64_t size() const { return (images.defined() ? images : points.defined() ? points : shape).size(0); }
};

/// The trunk of these options. num_shape: of SketchNetworkSizes.
models::TrunkOptions TrunkOf(const SketchNetworkOptions& options, int num_shape);

/// Images of one channel, (B, 1, R, R), marked channels-last. This moves no memory, but the convolutions that follow
/// keep the layout, which is faster. Undefined images stay undefined.
torch::Tensor ChannelsLast(const torch::Tensor& images);

/// @throws Error if the models do not belong together.
SketchNetworkSizes SizesOf(const FittedModels& models);

/// u: (B, Ku), v: (B, Kv) of the bilinear model, in its own units; residual: (B, R) in cm, undefined if there is none.
struct FaceCoefficients {
  torch::Tensor u, v, residual;
};

/// Sketch -> u, v of a bilinear face [Han et al. 2017, section 4.3, figure 7]: a trunk, and behind it two branches of
/// fully connected layers (ReLU) with an output layer each, or one branch with both. The curve coefficients,
/// standardised, pass a layer of their own for each branch and join its last features ("late"), or join the features
/// of the trunk as they are ("early", which the paper tried and dropped).
/// The outputs are standardised coefficients; u = mean + deviation * output, over the training identities, and v over
/// the training expressions. With a residual, one more output reads the last features of both branches.
/// Means, deviations, core or basis are buffers, so that a checkpoint is whole.
/// Runs of widths that a training refuses today (RequireWholeBlocks) still predict, their convolutions in plain layout.
class SketchNetworkImpl : public torch::nn::Module {
 public:
  /// Of models with any numbers: shipped weights fill them.
  SketchNetworkImpl(const SketchNetworkOptions& options, const SketchNetworkSizes& sizes);
  /// @throws Error if the models do not belong together, or a wanted basis has another size than options.residual.
  SketchNetworkImpl(const SketchNetworkOptions& options, const FittedModels& models);

  /// The last features of the branches; the same tensor twice where there is one branch alone.
  struct BranchFeatures {
    torch::Tensor identity, expression;
  };
  /// @throws Error if what is read is missing or has another shape.
  BranchFeatures Features(const SketchInput& input);
  FaceCoefficients Predict(const BranchFeatures& features);
  /// Predict(Features(input)).
  FaceCoefficients forward(const SketchInput& input) { return Predict(Features(input)); }

  /// (B, K), so that the faces are Linear(c) * basis(): the products u_k v_l, or with a residual their coordinates in
  /// the basis plus the residual. @throws Error if the shapes disagree with the model.
  torch::Tensor Linear(const FaceCoefficients& coefficients) const;
  /// (K, 3V) in cm, on the network's device.
  const torch::Tensor& basis() const { return basis_; }
  /// (B, 3V) coordinates in cm: C x2 u x3 v, plus the residual if there is one.
  torch::Tensor Decode(const FaceCoefficients& coefficients) const { return torch::mm(Linear(coefficients), basis_); }

  /// Frozen convolutions are not trained, and normalise as in evaluation.
  void FreezeConvolutions(bool frozen);
  void train(bool on = true) override;
  /// Standardised coefficients: the output of the last layers for these u and v.
  FaceCoefficients Standardised(const FaceCoefficients& coefficients) const;
  /// Curve coefficients from standardised ones, (B, S).
  torch::Tensor ShapeOf(const torch::Tensor& standardised) const {
    return shape_mean_ + shape_deviation_ * standardised;
  }

  const SketchNetworkOptions& options() const { return options_; }
  /// Trained numbers; buffers do not count.
  int64_t num_parameters() const;
  int64_t num_identity() const { return u_mean_.size(0); }
  int64_t num_expression() const { return v_mean_.size(0); }
  int64_t num_shape() const { return shape_mean_.size(0); }
  int64_t num_vertices() const { return basis_.size(1) / 3; }
  /// Widths of the branches' last features.
  int64_t num_identity_features() const { return identity_width_; }
  int64_t num_expression_features() const { return expression_width_; }

 private:
  void RegisterBuffers(const SketchNetworkSizes& sizes);

  SketchNetworkOptions options_;
  models::SketchTrunk trunk_;
  torch::nn::Sequential identity_branch_{nullptr}, expression_branch_{nullptr};
  torch::nn::Linear identity_shape_{nullptr}, expression_shape_{nullptr};
  torch::nn::Linear identity_output_{nullptr}, expression_output_{nullptr}, residual_output_{nullptr};
  int64_t identity_width_ = 0, expression_width_ = 0;
  bool frozen_ = false;
  torch::Tensor u_mean_, u_deviation_, v_mean_, v_deviation_, shape_mean_, shape_deviation_, residual_deviation_;
  torch::Tensor products_;  ///< (Ku * Kv, R): the core in the basis; of networks with a residual.
  torch::Tensor basis_;
};
TORCH_MODULE(SketchNetwork);

}  // namespace daumier::sketch
