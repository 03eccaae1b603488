#pragma once
#include "datasets/read/splits.h"
#include "faces/face_database.h"
#include "systems/expression/options.h"
#include "train/recipe.h"

#include <torch/nn/modules/linear.h>
#include <torch/nn/pimpl.h>

#include <map>
#include <string>
#include <vector>

namespace daumier::expression {

/// Vertices (B, 3V), cm -> scores of the expressions (B, E), without softmax: two layers on the difference from a mean
/// face, which is part of the weights.
class ExpressionNetworkImpl : public torch::nn::Module {
 public:
  ExpressionNetworkImpl(const NetworkOptions& options, int64_t num_vertices, int64_t num_expressions);
  torch::Tensor forward(const torch::Tensor& vertices);
  void SetMean(const torch::Tensor& face);

 private:
  torch::Tensor mean_;
  torch::nn::Linear hidden_, scores_;
};
TORCH_MODULE(ExpressionNetwork);

/// Of the grid's faces: an interpolated one shows no single expression.
std::vector<int> LabelledFaces(const faces::FaceDatabase& faces, const std::vector<int>& subset);
/// vertices (B, 3V), expressions (B).
SampleBatch ReadFaces(const faces::FaceDatabase& faces, std::span<const int> indices);
/// The expression of the greatest score of each face.
std::vector<int64_t> PredictedExpressions(ExpressionNetwork& network, const faces::FaceDatabase& faces,
                                          const std::vector<int>& indices);

/// Minimises the mean cross-entropy (losses::StateLoss); validation reports error_percent.
class ExpressionRecipe : public train::Recipe {
 public:
  /// Draws the first weights from LibTorch's CPU generator. @throws Error if there is no face to validate on.
  ExpressionRecipe(const TrainingOptions& options, const faces::FaceDatabase& faces, const datasets::Split& split,
                   torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return int(training_.size()); }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override;
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "error_percent"; }

 private:
  const faces::FaceDatabase& faces_;
  std::vector<int> training_, validation_;
  torch::Device device_;
  ExpressionNetwork network_;
};

}  // namespace daumier::expression
