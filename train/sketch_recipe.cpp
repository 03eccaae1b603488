#include "train/sketch_recipe.h"

#include "core/error.h"
#include "eval/metrics.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <numeric>

namespace daumier::train {
namespace {

/// Faces whose vertices are in memory at once.
constexpr int kBlock = 64;

std::vector<int> Indices(int begin, int end) {
  std::vector<int> indices(size_t(end - begin));
  std::iota(indices.begin(), indices.end(), begin);
  return indices;
}

/// The same lines, in the exact view, as they are.
datasets::SketchVariation Exact(datasets::SketchVariation variation) {
  variation.all_views = false;
  variation.augmentation.strength = 0;
  return variation;
}

}  // namespace

torch::Tensor CurveVertexWeights(const faces::FaceTemplate& face_template, double curve_weight) {
  std::vector<float> weights(size_t(face_template.num_vertices()), 1.0f);
  for (const faces::FeatureCurve& curve : face_template.annotation.curves)
    for (const int vertex : curve.vertices) weights[size_t(vertex)] = float(curve_weight);
  return torch::tensor(weights);
}

SketchRecipe::SketchRecipe(const SketchTrainingOptions& options, const faces::FaceDatabase& faces,
                           const datasets::SketchDatabase& sketches, const datasets::Split& split,
                           const faces::BilinearModel& bilinear, torch::Device device)
    : faces_(faces),
      device_(device),
      training_(sketches, split.train, options.network.resolution, options.sketch, options.seed),
      validation_(sketches, split.validation, options.network.resolution, Exact(options.sketch)),
      network_(options.network, bilinear),
      vertex_weights_(CurveVertexWeights(faces.face_template(), options.curve_weight).to(device)) {
  DAUMIER_CHECK(training_.size() > 0 && validation_.size() > 0,
                "a training needs training and validation faces, here {} and {}: see split.validation and split.test",
                training_.size(), validation_.size());
  network_->to(device_);
  if (options.loss == "gram") PrecomputeMoments();
}

torch::Tensor SketchRecipe::Targets(std::span<const int> faces) const {
  const int64_t num_coordinates = 3 * int64_t(faces_.num_vertices());
  torch::Tensor targets = torch::empty({int64_t(faces.size()), num_coordinates});
  for (size_t row = 0; row < faces.size(); ++row) {
    const std::span<const float> vertices = faces_.vertices(faces[row]);
    std::copy(vertices.begin(), vertices.end(), targets.data_ptr<float>() + int64_t(row) * num_coordinates);
  }
  return targets.to(device_);
}

void SketchRecipe::PrecomputeMoments() {
  gram_loss_.emplace(network_->core(), vertex_weights_);
  std::vector<torch::Tensor> linear, constant;
  const std::span<const int> faces = training_.faces();
  for (size_t begin = 0; begin < faces.size(); begin += kBlock) {
    const losses::VertexMoments block =
        gram_loss_->Moments(Targets(faces.subspan(begin, std::min<size_t>(kBlock, faces.size() - begin))));
    linear.push_back(block.linear);
    constant.push_back(block.constant);
  }
  moments_ = {torch::cat(linear), torch::cat(constant)};
}

losses::VertexMoments SketchRecipe::MomentsOf(const std::vector<int>& samples) const {
  const torch::Tensor rows = torch::tensor(samples, torch::kInt64).to(device_);
  return {moments_.linear.index_select(0, rows), moments_.constant.index_select(0, rows)};
}

LossTerms SketchRecipe::Loss(const std::vector<int>& samples, int64_t epoch) {
  const datasets::SketchBatch batch = training_.Get(samples, epoch);
  const models::FaceCoefficients coefficients = network_->forward(batch.images.to(device_));
  if (gram_loss_) return {(*gram_loss_)(coefficients.u, coefficients.v, MomentsOf(samples)), {}};
  std::vector<int> faces;
  for (const int sample : samples) faces.push_back(training_.faces()[size_t(sample)]);
  return {losses::VertexLoss(network_->core(), coefficients.u, coefficients.v, Targets(faces), vertex_weights_), {}};
}

std::map<std::string, double> SketchRecipe::Validate() {
  const std::vector<int>& region = faces_.face_template().annotation.regions.at("face");
  const double mm_per_cm = faces::MillimetresPerCm(faces_.face_template());
  std::vector<double> errors;
  for (int begin = 0; begin < validation_.size(); begin += kBlock) {
    const std::vector<int> samples = Indices(begin, std::min(begin + kBlock, validation_.size()));
    const torch::Tensor predicted =
        network_->Decode(network_->forward(validation_.Get(samples).images.to(device_))).to(torch::kCPU).contiguous();
    const size_t num_coordinates = size_t(predicted.size(1));
    for (size_t row = 0; row < samples.size(); ++row) {
      errors.push_back(eval::MeanVertexError({predicted.data_ptr<float>() + row * num_coordinates, num_coordinates},
                                             faces_.vertices(validation_.faces()[size_t(samples[row])]), region,
                                             mm_per_cm));
    }
  }
  return {{metric(), eval::Mean(errors)}};
}

tensor::NamedTensors SketchRecipe::BatchTensors(const std::vector<int>& samples, int64_t epoch) {
  const datasets::SketchBatch batch = training_.Get(samples, epoch);
  return {{"images", batch.images}, {"faces", batch.faces}};
}

}  // namespace daumier::train
