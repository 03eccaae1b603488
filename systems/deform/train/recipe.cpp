#include "systems/deform/train/recipe.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "systems/deform/train/unseen_faces.h"
#include "tensor/array.h"
#include "tensor/torch_version.h"

#include <algorithm>
#include <numeric>

namespace daumier::deform {
namespace {

torch::Tensor TemplateOf(const datasets::PointDatabase& points) {
  const auto vertices = points.template_vertices();
  torch::Tensor tensor = torch::empty({points.num_vertices(), 3});
  std::copy(vertices.begin(), vertices.end(), tensor.data_ptr<float>());
  return tensor;
}

/// All vertices of all faces, (n, V, 3) in the model's frame.
torch::Tensor TargetsOf(const datasets::PointDataset& dataset) {
  std::vector<int> samples(size_t(dataset.size()));
  std::iota(samples.begin(), samples.end(), 0);
  return tensor::TakeTensor(std::move(dataset.Vertices(samples).arrays.at("targets")));
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
  if (options.trainer.precision != "float32")
    throw UsageError(fmt::format("precision=\"{}\": deformable models train in float32", options.trainer.precision));
  decoder_ = std::make_shared<AutoDecoder>(MakeDeformNetwork(options.network, TemplateOf(points), points.frame()),
                                           int64_t(split.train.size()));
  decoder_->to(device_);
  const datasets::PointDataset validation(faces, points, EvenlySpaced(split.validation, options.validation.faces),
                                          options.points, options.seed);
  validation_vertices_ = TargetsOf(validation).to(device_);
}

torch::Tensor DeformRecipe::TrainingVertices() const {
  return TargetsOf(training_);
}

train::LossTerms DeformRecipe::Loss(const train::Batch& batch) {
  const torch::Tensor codes = decoder_->codes().index_select(0, batch.samples);
  const torch::Tensor positions =
      decoder_->network()->Deform(codes, {batch.at("corners"), batch.at("weights"), batch.at("positions")});
  const torch::Tensor miss = positions - batch.at("targets");
  const torch::Tensor data = miss.square().mean(), prior = codes.square().mean();
  return {options_.loss.data_weight * data + options_.loss.code_weight * prior,
          {{"mean_square", data},
           {"code_square", prior},
           {"training_error_mm", mm_per_unit_ * miss.detach().norm(2, 2).mean()}}};
}

std::map<std::string, double> DeformRecipe::Validate() {
  const CodeFitOptions fit{.data_weight = options_.loss.data_weight,
                           .code_weight = options_.loss.code_weight,
                           .solve = {.newton_steps = options_.validation.newton_steps}};
  const double error = UnseenError(*decoder_->network(), validation_vertices_, fit);
  return {{"vertex_error", error}, {"mean_vertex_error_mm", mm_per_unit_ * error}};
}

}  // namespace daumier::deform
