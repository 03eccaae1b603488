#include "train/deform_recipe.h"

#include "core/error.h"
#include "core/even_choice.h"
#include "eval/unseen_faces.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <numeric>

namespace daumier::train {
namespace {

torch::Tensor TemplateOf(const datasets::PointDatabase& points) {
  const auto vertices = points.template_vertices();
  torch::Tensor tensor = torch::empty({points.num_vertices(), 3});
  std::copy(vertices.begin(), vertices.end(), tensor.data_ptr<float>());
  return tensor;
}

std::vector<int> AllOf(const datasets::PointDataset& dataset) {
  std::vector<int> samples(size_t(dataset.size()));
  std::iota(samples.begin(), samples.end(), 0);
  return samples;
}

}  // namespace

DeformRecipe::DeformRecipe(const DeformTrainingOptions& options, const faces::FaceDatabase& faces,
                           const datasets::PointDatabase& points, const datasets::Split& split, torch::Device device)
    : options_(options),
      mm_per_unit_(faces::MillimetresPerCm(faces.face_template()) / points.frame().scale),
      device_(device),
      training_(faces, points, split.train, options.points, options.seed) {
  DAUMIER_CHECK(!split.train.empty() && !split.validation.empty(),
                "a training needs training and validation faces, here {} and {}: see split.validation and split.test",
                split.train.size(), split.validation.size());
  decoder_ = std::make_shared<models::AutoDecoder>(
      models::MakeDeformNetwork(options.network, TemplateOf(points), points.frame()), int64_t(split.train.size()));
  decoder_->to(device_);
  const datasets::PointDataset validation(faces, points, EvenChoice(split.validation, options.validation.faces),
                                          options.points, options.seed);
  validation_vertices_ = validation.Vertices(AllOf(validation)).targets.to(device_);
}

torch::Tensor DeformRecipe::TrainingVertices() const {
  return training_.Vertices(AllOf(training_)).targets;
}

LossTerms DeformRecipe::Loss(const std::vector<int>& samples, int64_t epoch) {
  const datasets::PointBatch batch = training_.Get(samples, epoch);
  const torch::Tensor codes = decoder_->codes().index_select(0, torch::tensor(samples, torch::kInt64).to(device_));
  const torch::Tensor positions = decoder_->network()->Deform(
      codes, {batch.corners.to(device_), batch.weights.to(device_), batch.positions.to(device_)});
  const torch::Tensor miss = positions - batch.targets.to(device_);
  const torch::Tensor data = miss.square().mean(), prior = codes.square().mean();
  return {options_.loss.data_weight * data + options_.loss.code_weight * prior,
          {{"mean_square", data},
           {"code_square", prior},
           {"training_error_mm", mm_per_unit_ * miss.detach().norm(2, 2).mean()}}};
}

std::map<std::string, double> DeformRecipe::Validate() {
  const fitting::CodeFitOptions fit{.data_weight = options_.loss.data_weight,
                                    .code_weight = options_.loss.code_weight,
                                    .solve = {.newton_steps = options_.validation.newton_steps}};
  const double error = eval::UnseenError(*decoder_->network(), validation_vertices_, fit);
  return {{"vertex_error", error}, {"mean_vertex_error_mm", mm_per_unit_ * error}};
}

tensor::NamedTensors DeformRecipe::BatchTensors(const std::vector<int>& samples, int64_t epoch) {
  const datasets::PointBatch batch = training_.Get(samples, epoch);
  return {{"positions", batch.positions}, {"targets", batch.targets}};
}

}  // namespace daumier::train
