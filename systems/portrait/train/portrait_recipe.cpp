#include "systems/portrait/train/portrait_recipe.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "fitting/portrait_fit.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/train/portrait_prediction.h"
#include "tensor/torch_version.h"

#include <numeric>

namespace daumier::portrait {
namespace {

std::vector<int> TrainingImages(const PortraitTrainingOptions& options, const std::vector<int>& images) {
  return options.max_images > 0 ? EvenlySpaced(images, options.max_images) : images;
}

/// The pose in which the mean face explains the mean landmarks of some training crops best.
fitting::PortraitPose UsualPose(const faces::MorphableModel& model, const datasets::PortraitDatabase& portraits,
                                const std::vector<int>& images, const PortraitTrainingOptions& options) {
  constexpr int kMost = 500;
  fitting::PicturePoints mean = fitting::PicturePoints::Zero(68, 2);
  const std::vector<int> some = EvenlySpaced(images, kMost);
  for (const int image : some) {
    const std::vector<float> landmarks =
        MapLandmarks(portraits.landmarks(image), PlainCrop(portraits, image, options.pictures));
    for (int n = 0; n < 68; ++n) mean.row(n) += Eigen::RowVector2d(landmarks[2 * n], landmarks[2 * n + 1]);
  }
  mean /= double(some.size());
  return fitting::FitPortrait(fitting::LandmarkModel(model), mean, Eigen::VectorXd::Ones(68),
                              {.freedom = fitting::PortraitFreedom::kPose})
      .pose();
}

}  // namespace

PortraitRecipe::PortraitRecipe(const PortraitTrainingOptions& options, const faces::MorphableModel& model,
                               const datasets::PortraitDatabase& portraits, const PortraitSets& sets,
                               torch::Device device)
    : options_(options),
      device_(device),
      training_(portraits, TrainingImages(options, sets.train), sets.real, options, Jitter::kRandom,
                {.picture = options.loss.renders(), .vertices = options.loss.reads_vertices()}),
      validation_(portraits, EvenlySpaced(sets.validation, options.validation_images), nullptr, options, Jitter::kNone,
                  {.picture = false, .vertices = true}),
      loss_(model, options.loss),
      measure_(model.face_template) {
  DAUMIER_CHECK(!sets.train.empty() && !sets.validation.empty(),
                "a training needs training and validation portraits, here {} and {}: see split.validation and "
                "pictures.leave_out",
                sets.train.size(), sets.validation.size());
  if (!device.is_cpu()) throw UsageError("the renderer of portraits runs on the CPU: train with --device cpu");
  network_ =
      PortraitNetwork(options.network, model.expression_weights, UsualPose(model, portraits, sets.train, options));
  std::vector<int> samples(size_t(validation_.size()));
  std::iota(samples.begin(), samples.end(), 0);
  validation_batch_ = validation_.Get(samples, 0);
}

train::LossTerms PortraitRecipe::Loss(const train::Batch& batch) {
  const torch::Tensor coefficients = network_->forward(batch.at("input"));
  return loss_(coefficients, batch);
}

std::map<std::string, double> PortraitRecipe::Validate() {
  const at::NoGradGuard no_grad;
  const train::Batch batch = train::ToDevice(validation_batch_, device_);
  const PredictedPortraits predicted = PredictPortraits(network_, loss_.renderer(), batch.at("input"));
  const torch::Tensor truth = batch.at("vertices"), landmarks = batch.at("landmarks"), angles = batch.at("angles");
  const int64_t count = truth.size(0);
  double vertex_error = 0, landmark_error = 0, angle_error = 0;
  for (int64_t i = 0; i < count; ++i) {
    const torch::Tensor x = predicted.coefficients.slice(0, i, i + 1);
    const torch::Tensor vertices = loss_.renderer().layer().Vertices(x);
    vertex_error += measure_.SimilarityErrorMm(VerticesOf(vertices, 0), VerticesOf(truth, i));
    const torch::Tensor p = predicted.landmarks[i].contiguous(), q = landmarks[i].contiguous();
    landmark_error += NormalisedError({p.data_ptr<float>(), 136}, {q.data_ptr<float>(), 136});
    fitting::PortraitPose pose = fitting::PortraitPose::Zero(), true_pose = pose;
    for (int64_t k = 0; k < 3; ++k) {
      pose[k] = x[0][faces::kPoseSlot.first + k].item<double>();
      true_pose[k] = angles[i][k].item<double>();
    }
    angle_error += fitting::AngleBetween(pose, true_pose);
  }
  const auto n = double(count);
  return {{"vertex_error_mm", vertex_error / n},
          {"landmark_error", landmark_error / n},
          {"angle_error_degrees", angle_error / n}};
}

}  // namespace daumier::portrait
