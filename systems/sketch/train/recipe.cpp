#include "systems/sketch/train/recipe.h"

#include "core/error.h"
#include "core/parallel.h"
#include "datasets/read/training_fit.h"
#include "eval/metrics.h"
#include "systems/sketch/coefficient_targets.h"
#include "systems/sketch/train/reader.h"
#include "tensor/array.h"
#include "tensor/autocast.h"
#include "tensor/eigen.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <torch/nn/functional/loss.h>

#include <algorithm>
#include <numeric>

namespace daumier::sketch {
namespace {

namespace nn = torch::nn;

/// The label that LibTorch's cross-entropy ignores.
constexpr int64_t kNoClass = -100;

std::vector<int> Indices(int begin, int end) {
  std::vector<int> indices(size_t(end - begin));
  std::iota(indices.begin(), indices.end(), begin);
  return indices;
}

/// The same lines in the exact view.
datasets::SketchVariation InExactView(datasets::SketchVariation variation) {
  variation.all_views = false;
  return variation;
}

/// Sum over the samples that have a class, over the number of all samples.
torch::Tensor CrossEntropy(const torch::Tensor& scores, const torch::Tensor& classes) {
  const auto options = nn::functional::CrossEntropyFuncOptions().ignore_index(kNoClass).reduction(torch::kSum);
  return nn::functional::cross_entropy(scores, classes, options) / double(scores.size(0));
}

SketchInput InputOf(const train::Batch& batch) {
  return {ChannelsLast(batch.find("images")), batch.find("points"), batch.find("shape")};
}

torch::Tensor MeanSquaredLength(const torch::Tensor& rows) {
  return rows.square().sum() / double(rows.size(0));
}

}  // namespace

torch::Tensor CurveVertexWeights(const faces::FaceTemplate& face_template, double curve_weight) {
  std::vector<float> weights(size_t(face_template.num_vertices()), 1.0f);
  for (const faces::FeatureCurve& curve : face_template.annotation.curves)
    for (const int vertex : curve.vertices) weights[size_t(vertex)] = float(curve_weight);
  return torch::tensor(weights);
}

SketchClassifierImpl::SketchClassifierImpl(SketchNetwork network, int num_identities, int num_expressions)
    : network_(register_module("network", std::move(network))),
      identity_(register_module("identity", nn::Linear(network_->num_identity_features(), num_identities))),
      expression_(register_module("expression", nn::Linear(network_->num_expression_features(), num_expressions))) {}

SketchClassifierImpl::Scores SketchClassifierImpl::forward(const SketchNetworkImpl::BranchFeatures& features) {
  return {identity_->forward(features.identity), expression_->forward(features.expression)};
}

SketchRecipe::SketchRecipe(const SketchTrainingOptions& options, const faces::FaceDatabase& faces,
                           const datasets::SketchDatabase& sketches, const datasets::Split& split,
                           const FittedModels& models, torch::Device device)
    : options_(options),
      faces_(faces),
      device_(device),
      encoder_(models.curves),
      training_(sketches, split.train, Reading(/*fixed=*/false), options.sketch, options.seed),
      validation_(sketches, split.validation, Reading(/*fixed=*/true), InExactView(options.sketch), options.seed),
      network_(options.network, models),
      vertex_weights_(CurveVertexWeights(faces.face_template(), options.curve_weight).to(device)) {
  DAUMIER_CHECK(training_.size() > 0 && validation_.size() > 0,
                "a training needs training and validation faces, here {} and {}: see split.validation and split.test",
                training_.size(), validation_.size());
  const SketchStageOptions& stages = options.stages;
  if (stages.classification + stages.regression > 1) {
    throw UsageError(fmt::format("stages.classification and stages.regression add up to {}, at most 1 can be",
                                 stages.classification + stages.regression));
  }
  const std::vector<int> identities = datasets::TrainingIdentities(faces, split);
  if (stages.classification > 0) {
    classifier_ = SketchClassifier(network_, int(identities.size()), faces.num_expressions());
    PrecomputeClasses(identities);
  }
  module().to(device_);
  if (stages.regression > 0) PrecomputeCoefficients(identities, models.bilinear);
  if (options.loss == "gram") PrecomputeMoments();
}

torch::nn::Module& SketchRecipe::module() {
  if (classifier_) return *classifier_;
  return *network_;
}

std::vector<train::Stage> SketchRecipe::stages() const {
  const SketchStageOptions& options = options_.stages;
  return {{"classification", options.classification, options.classification_rate},
          {"regression", options.regression, options.regression_rate},
          {"tuning", 1 - options.classification - options.regression, options.tuning_rate}};
}

void SketchRecipe::EnterStage(int stage) {
  stage_ = stages()[size_t(stage)].name;
  network_->FreezeConvolutions(stage_ == "regression");
}

datasets::SketchReading SketchRecipe::Reading(bool fixed) const {
  const SketchNetworkOptions& network = options_.network;
  return {.resolution = network.reads_image() ? network.resolution : 0,
          .num_points = network.reads_points() ? network.num_points : 0,
          .encoder = network.reads_shape() ? &encoder_ : nullptr,
          .fixed = fixed};
}

FloatArray SketchRecipe::Vertices(std::span<const int> faces) const {
  FloatArray vertices({int64_t(faces.size()), 3 * int64_t(faces_.num_vertices())});
  for (size_t row = 0; row < faces.size(); ++row)
    std::ranges::copy(faces_.vertices(faces[row]), vertices.row(int64_t(row)));
  return vertices;
}

void SketchRecipe::PrecomputeMoments() {
  gram_loss_.emplace(network_->basis(), vertex_weights_);
  std::vector<torch::Tensor> linear, constant;
  const std::span<const int> faces = training_.faces();
  for (size_t begin = 0; begin < faces.size(); begin += kBlock) {
    const losses::SufficientStatistics block = gram_loss_->Moments(
        tensor::TakeTensor(Vertices(faces.subspan(begin, std::min(kBlock, faces.size() - begin)))).to(device_));
    linear.push_back(block.linear);
    constant.push_back(block.constant);
  }
  moments_ = {torch::cat(linear), torch::cat(constant)};
}

void SketchRecipe::PrecomputeClasses(const std::vector<int>& identities) {
  std::vector<int64_t> identity, expression;
  for (const int face : training_.faces()) {
    if (face >= faces_.num_grid_faces()) {
      identity.push_back(kNoClass);
      expression.push_back(kNoClass);
      continue;
    }
    const auto found = std::lower_bound(identities.begin(), identities.end(), face / faces_.num_expressions());
    identity.push_back(found - identities.begin());
    expression.push_back(face % faces_.num_expressions());
  }
  identity_classes_ = torch::tensor(identity).to(device_);
  expression_classes_ = torch::tensor(expression).to(device_);
}

void SketchRecipe::PrecomputeCoefficients(const std::vector<int>& identities, const faces::BilinearModel& bilinear) {
  const std::span<const int> faces = training_.faces();
  tensor::RowMajorMatrix<float> u(faces.size(), bilinear.num_identity), v(faces.size(), bilinear.num_expression);
  const CoefficientTargets targets(faces_, identities, bilinear);
  Eigen::Index row = 0;
  ForEachInOrder(
      int(faces.size()), [&](int sample) { return targets.Of(faces[size_t(sample)]); },
      [&](const faces::BilinearProjection& face) {
        u.row(row) = face.u.transpose();
        v.row(row++) = face.v.transpose();
      });
  coefficients_ = {tensor::CopyToTensor(u).to(device_), tensor::CopyToTensor(v).to(device_), {}};
}

SampleBatch SketchRecipe::Read(std::span<const int> samples, int64_t epoch) const {
  SampleBatch batch = training_.Get(samples, epoch);
  if (gram_loss_) return batch;
  std::vector<int> faces;
  for (const int sample : samples) faces.push_back(training_.faces()[size_t(sample)]);
  batch.arrays["vertices"] = Vertices(faces);
  return batch;
}

train::LossTerms SketchRecipe::Loss(const train::Batch& batch) {
  const SketchNetworkImpl::BranchFeatures features = Features(batch);
  const tensor::Autocast full(device_, false);
  if (stage_ == "classification") return ClassificationLoss(features, batch.samples);
  if (stage_ == "regression") return RegressionLoss(features, batch.samples);
  return VertexLoss(features, batch);
}

SketchNetworkImpl::BranchFeatures SketchRecipe::Features(const train::Batch& batch) {
  const auto [identity, expression] = network_->Features(InputOf(batch));
  return {identity.to(torch::kFloat32), expression.to(torch::kFloat32)};
}

train::LossTerms SketchRecipe::ClassificationLoss(const SketchNetworkImpl::BranchFeatures& features,
                                                  const torch::Tensor& samples) {
  const auto scores = classifier_->forward(features);
  const torch::Tensor identity = CrossEntropy(scores.identity, identity_classes_.index_select(0, samples)),
                      expression = CrossEntropy(scores.expression, expression_classes_.index_select(0, samples));
  return {identity + expression, {{"identity_entropy", identity}, {"expression_entropy", expression}}};
}

train::LossTerms SketchRecipe::RegressionLoss(const SketchNetworkImpl::BranchFeatures& features,
                                              const torch::Tensor& samples) {
  const auto predicted = network_->Standardised(network_->Predict(features));
  const auto truth =
      network_->Standardised({coefficients_.u.index_select(0, samples), coefficients_.v.index_select(0, samples), {}});
  const torch::Tensor u = MeanSquaredLength(predicted.u - truth.u), v = MeanSquaredLength(predicted.v - truth.v);
  return {u + v, {{"u_error", u}, {"v_error", v}}};
}

train::LossTerms SketchRecipe::VertexLoss(const SketchNetworkImpl::BranchFeatures& features,
                                          const train::Batch& batch) {
  const torch::Tensor linear = network_->Linear(network_->Predict(features));
  if (!gram_loss_) return {losses::VertexLoss(network_->basis(), linear, batch.at("vertices"), vertex_weights_), {}};
  const losses::SufficientStatistics moments{moments_.linear.index_select(0, batch.samples),
                                             moments_.constant.index_select(0, batch.samples)};
  return {(*gram_loss_)(linear, moments), {}};
}

std::map<std::string, double> SketchRecipe::Validate() {
  const std::vector<int>& region = faces::RegionFor(faces_.face_template().annotation, "face", "errors");
  const double mm_per_cm = faces::MillimetresPerCm(faces_.face_template());
  std::vector<double> errors;
  for (int begin = 0; begin < validation_.size(); begin += int(kBlock)) {
    const std::vector<int> samples = Indices(begin, std::min(begin + int(kBlock), validation_.size()));
    const torch::Tensor predicted =
        network_->Decode(network_->forward(InputOf(train::ToDevice(validation_.Get(samples), device_))))
            .to(torch::kCPU)
            .contiguous();
    const size_t num_coordinates = size_t(predicted.size(1));
    for (size_t row = 0; row < samples.size(); ++row) {
      errors.push_back(eval::MeanVertexError({predicted.data_ptr<float>() + row * num_coordinates, num_coordinates},
                                             faces_.vertices(validation_.faces()[size_t(samples[row])]), region,
                                             mm_per_cm));
    }
  }
  return {{metric(), eval::Mean(errors)}};
}

}  // namespace daumier::sketch
