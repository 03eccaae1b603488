#include "systems/expression/train/recipe.h"

#include "core/error.h"
#include "losses/state_loss.h"
#include "tensor/array.h"

#include <algorithm>

namespace daumier::expression {

ExpressionNetworkImpl::ExpressionNetworkImpl(const NetworkOptions& options, int64_t num_vertices,
                                             int64_t num_expressions)
    : mean_(register_buffer("mean", torch::zeros({3 * num_vertices}))),
      hidden_(register_module("hidden", torch::nn::Linear(3 * num_vertices, options.hidden))),
      scores_(register_module("scores", torch::nn::Linear(options.hidden, num_expressions))) {}

torch::Tensor ExpressionNetworkImpl::forward(const torch::Tensor& vertices) {
  return scores_->forward(hidden_->forward(vertices - mean_).relu());
}

void ExpressionNetworkImpl::SetMean(const torch::Tensor& face) {
  mean_.copy_(face);
}

std::vector<int> LabelledFaces(const faces::FaceDatabase& faces, const std::vector<int>& subset) {
  std::vector<int> labelled;
  std::ranges::copy_if(subset, std::back_inserter(labelled), [&](int face) { return face < faces.num_grid_faces(); });
  return labelled;
}

SampleBatch ReadFaces(const faces::FaceDatabase& faces, std::span<const int> indices) {
  SampleBatch batch{.samples = {indices.begin(), indices.end()}, .arrays = {}, .indices = {}};
  FloatArray vertices({int64_t(indices.size()), 3 * int64_t(faces.num_vertices())});
  Array<int64_t> expressions({int64_t(indices.size())});
  for (size_t i = 0; i < indices.size(); ++i) {
    std::ranges::copy(faces.vertices(indices[i]), vertices.row(int64_t(i)));
    expressions.values[i] = faces.id(indices[i]).expression;
  }
  batch.arrays["vertices"] = std::move(vertices);
  batch.indices["expressions"] = std::move(expressions);
  return batch;
}

std::vector<int64_t> PredictedExpressions(ExpressionNetwork& network, const faces::FaceDatabase& faces,
                                          const std::vector<int>& indices) {
  const at::NoGradGuard no_grad;
  const torch::Device device = network->parameters().front().device();
  std::vector<int64_t> predicted;
  for (const int face : indices) {
    SampleBatch batch = ReadFaces(faces, {&face, 1});
    const torch::Tensor vertices = tensor::TakeTensor(std::move(batch.arrays.at("vertices"))).to(device);
    predicted.push_back(network->forward(vertices).argmax(1).item<int64_t>());
  }
  return predicted;
}

ExpressionRecipe::ExpressionRecipe(const TrainingOptions& options, const faces::FaceDatabase& faces,
                                   const datasets::Split& split, torch::Device device)
    : faces_(faces),
      training_(LabelledFaces(faces, split.train)),
      validation_(LabelledFaces(faces, split.validation)),
      device_(device),
      network_(options.network, faces.num_vertices(), faces.num_expressions()) {
  DAUMIER_CHECK(!validation_.empty(), "there is no face to validate on: see split.validation");
  SampleBatch all = ReadFaces(faces, training_);
  network_->SetMean(tensor::TakeTensor(std::move(all.arrays.at("vertices"))).mean(0));
  network_->to(device_);
}

SampleBatch ExpressionRecipe::Read(std::span<const int> samples, int64_t) const {
  std::vector<int> indices;
  for (const int sample : samples) indices.push_back(training_[size_t(sample)]);
  SampleBatch batch = ReadFaces(faces_, indices);
  batch.samples.assign(samples.begin(), samples.end());
  return batch;
}

train::LossTerms ExpressionRecipe::Loss(const train::Batch& batch) {
  const torch::Tensor scores = network_->forward(batch.at("vertices")).to(torch::kFloat32);
  const torch::Tensor entropy = losses::StateLoss(scores, {faces_.num_expressions()},
                                                  batch.at("expressions").unsqueeze(1), torch::ones({1}, device_));
  return {entropy, {{"cross_entropy", entropy}}};
}

std::map<std::string, double> ExpressionRecipe::Validate() {
  const std::vector<int64_t> predicted = PredictedExpressions(network_, faces_, validation_);
  double num_wrong = 0;
  for (size_t i = 0; i < predicted.size(); ++i) num_wrong += predicted[i] != faces_.id(validation_[i]).expression;
  return {{metric(), 100 * num_wrong / double(predicted.size())}};
}

}  // namespace daumier::expression
