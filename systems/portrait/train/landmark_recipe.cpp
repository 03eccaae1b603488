#include "systems/portrait/train/landmark_recipe.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "core/random.h"
#include "losses/box_loss.h"
#include "losses/heat_map_loss.h"
#include "losses/label_loss.h"
#include "losses/state_loss.h"
#include "render/heat_map_decoding.h"
#include "systems/portrait/landmark_views.h"
#include "systems/portrait/train/landmark_network.h"
#include "tensor/array.h"
#include "tensor/autocast.h"

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

static_assert(kUnknownLabel == losses::kNoLabel);

constexpr int kValidationBlock = 16;

ViewOptions ViewsOf(const LandmarkTrainingOptions& options) {
  return {options.network.resolution, options.views.hidden_weight, options.views.negative_share};
}

/// Scenes of a batch: a share of its samples, rounded up.
int64_t NumScenes(double share, size_t num_samples) {
  return int64_t(std::ceil(share * double(num_samples) - 1e-9));
}

/// The views of a batch as arrays; crops come first, then scenes.
class ViewArrays {
 public:
  ViewArrays(int64_t num_crops, int64_t num_scenes, int size)
      : pictures({num_crops + num_scenes, 3, size, size}),
        points({num_crops, kNumLandmarks, 2}),
        weights({num_crops, kNumLandmarks}),
        score({num_crops + num_scenes, SearchSide(size), SearchSide(size)}),
        box({num_crops + num_scenes, 4, SearchSide(size), SearchSide(size)}),
        box_weight({num_crops + num_scenes, SearchSide(size), SearchSide(size)}),
        labels({num_crops, LabelSide(size), LabelSide(size)}),
        states({num_crops, kNumFaceStates}) {}

  void SetPicture(int64_t row, const TrainingView& view) {
    std::ranges::copy(view.picture, pictures.row(row));
    std::ranges::copy(view.search.score, score.row(row));
    std::ranges::copy(view.search.box, box.row(row));
    std::ranges::copy(view.search.weight, box_weight.row(row));
  }
  void SetCrop(int64_t row, const TrainingView& view) {
    SetPicture(row, view);
    std::ranges::copy(view.points, points.row(row));
    std::ranges::copy(view.weights, weights.row(row));
    std::ranges::copy(view.labels, labels.row(row));
    std::ranges::copy(view.states, states.row(row));
  }
  SampleBatch Batch(std::span<const int> samples) && {
    SampleBatch batch;
    batch.samples.assign(samples.begin(), samples.end());
    batch.arrays = {{"pictures", std::move(pictures)}, {"points", std::move(points)},
                    {"weights", std::move(weights)},   {"score", std::move(score)},
                    {"box", std::move(box)},           {"box_weight", std::move(box_weight)}};
    batch.indices = {{"labels", std::move(labels)}, {"states", std::move(states)}};
    return batch;
  }

 private:
  FloatArray pictures, points, weights, score, box, box_weight;
  Array<int64_t> labels, states;
};

torch::Tensor ClassWeights(const LandmarkLossOptions& options) {
  std::vector<float> weights(size_t(kNumPictureClasses), 1);
  weights[size_t(PictureClass::kBackground)] = float(options.background_class_weight);
  weights[size_t(PictureClass::kEyes)] = float(options.eye_class_weight);
  for (const PictureClass part : {PictureClass::kBrows, PictureClass::kLips, PictureClass::kMouth, PictureClass::kEars})
    weights[size_t(part)] = float(options.part_class_weight);
  return torch::tensor(weights);
}

/// The first `count` entries of the maps of a batch.
models::HeatMapFeatures FirstOf(const models::HeatMapFeatures& features, int64_t count) {
  const auto first = [count](const torch::Tensor& maps) { return maps.narrow(0, 0, count); };
  return {first(features.half), first(features.quarter), first(features.eighth), first(features.sixteenth),
          first(features.context)};
}

/// Sums of a validation.
struct ValidationSums {
  double error = 0, eyes = 0;
  int64_t num_faces = 0, wrong_states = 0, num_states = 0;
  LabelCounts labels;
};

}  // namespace

LandmarkRecipe::LandmarkRecipe(const LandmarkTrainingOptions& options, const LandmarkSource& source,
                               std::vector<int> training, std::vector<int> validation, torch::Device device)
    : options_(options),
      source_(source),
      training_(std::move(training)),
      validation_(EvenlySpaced(validation, options.validation.samples)),
      device_(device),
      network_(MakeLandmarkNetwork(options.network)),
      class_weights_(ClassWeights(options.loss).to(device)),
      state_weights_(torch::ones({kNumFaceStates}).to(device)) {
  DAUMIER_CHECK(!training_.empty() && !validation_.empty(),
                "a training needs training and validation portraits, here {} and {}: see split.validation and "
                "split.test",
                training_.size(), validation_.size());
  network_->to(device_);
}

SampleBatch LandmarkRecipe::Read(std::span<const int> samples, int64_t epoch) const {
  const auto num_crops = int64_t(samples.size()), num_scenes = NumScenes(options_.views.scene_share, samples.size());
  const ViewOptions views = ViewsOf(options_);
  ViewArrays arrays(num_crops, num_scenes, views.size);
  std::vector<LandmarkSample> pictures;
  for (int64_t row = 0; row < num_crops; ++row) {
    const int sample = training_[size_t(samples[size_t(row)])];
    Rng rng = Stream(options_.seed, "landmark views", uint64_t(sample) * 100003 + uint64_t(epoch));
    pictures.push_back(source_.Get(sample));
    arrays.SetCrop(row, MakeTrainingView(pictures.back(), views, &options_.augmentation, rng));
  }
  for (int64_t scene = 0; scene < num_scenes; ++scene) {
    const int sample = training_[size_t(samples[size_t(scene)])];
    Rng rng = Stream(options_.seed, "landmark scenes", uint64_t(sample) * 100003 + uint64_t(epoch));
    // A third shows no face; a fifth of the others shows two.
    std::vector<const LandmarkSample*> shown;
    if (rng.Uniform() > 0.33) shown.push_back(&pictures[size_t(scene)]);
    if (!shown.empty() && rng.Uniform() < 0.2) shown.push_back(&pictures[size_t(rng.Below(pictures.size()))]);
    arrays.SetPicture(num_crops + scene, MakeScene(shown, views, options_.augmentation, rng));
  }
  return std::move(arrays).Batch(samples);
}

train::LossTerms LandmarkRecipe::Loss(const train::Batch& batch) {
  const int64_t num_crops = batch.samples.size(0);
  const models::HeatMapFeatures features = network_->Features(batch.at("pictures"));
  const torch::Tensor boxes = network_->Boxes(features);
  const models::HeatMapOutputs outputs = network_->Parse(FirstOf(features, num_crops));
  const tensor::Autocast full(device_, false);
  const auto exact = [](const torch::Tensor& scores) { return scores.to(torch::kFloat32); };
  const torch::Tensor points = losses::HeatMapLoss(exact(outputs.heat_maps), batch.at("points"), batch.at("weights"),
                                                   options_.network.deviation);
  const torch::Tensor labels = losses::LabelLoss(exact(outputs.labels), batch.at("labels"), class_weights_);
  const torch::Tensor states =
      losses::StateLoss(exact(outputs.states), network_->options().states, batch.at("states"), state_weights_);
  const losses::BoxLossTerms search =
      losses::BoxLoss(exact(boxes), {batch.at("score"), batch.at("box"), batch.at("box_weight")});
  const LandmarkLossOptions& weights = options_.loss;
  return {points + weights.label_weight * labels + weights.state_weight * states + weights.score_weight * search.score +
              weights.box_weight * search.box,
          {{"heat_maps", points},
           {"labels", labels},
           {"states", states},
           {"box_score", search.score},
           {"box_size", search.box}}};
}

std::map<std::string, double> LandmarkRecipe::Validate() {
  const ViewOptions views = ViewsOf(options_);
  const int size = views.size, side = HeatMapSide(size);
  ValidationSums sums;
  for (size_t begin = 0; begin < validation_.size(); begin += kValidationBlock) {
    const size_t count = std::min(size_t(kValidationBlock), validation_.size() - begin);
    std::vector<TrainingView> block;
    FloatArray pictures({int64_t(count), 3, size, size});
    for (size_t i = 0; i < count; ++i) {
      Rng rng = Stream(options_.seed, "landmark validation", begin + i);
      block.push_back(MakeTrainingView(source_.Get(validation_[begin + i]), views, nullptr, rng));
      std::ranges::copy(block.back().picture, pictures.row(int64_t(i)));
    }
    const models::HeatMapOutputs outputs =
        network_->Parse(network_->Features(tensor::TakeTensor(std::move(pictures)).to(device_)));
    const FloatArray maps = tensor::CopyToArray<float>(outputs.heat_maps),
                     states = tensor::CopyToArray<float>(outputs.states);
    const Array<int64_t> labels = tensor::CopyToArray<int64_t>(outputs.labels.argmax(1));
    for (size_t i = 0; i < count; ++i) {
      const TrainingView& view = block[i];
      std::vector<float> points;
      for (const render::Peak& peak : render::FindPeaks({maps.row(int64_t(i)), size_t(maps.row_size())}, kNumLandmarks,
                                                        side, side, {.deviation = options_.network.deviation})) {
        points.push_back(float(peak.x));
        points.push_back(float(peak.y));
      }
      sums.error += NormalisedError(points, view.points);
      sums.eyes += NormalisedError(points, view.points, kLandmarkParts[3].begin, kLandmarkParts[3].end);
      ++sums.num_faces;
      sums.labels.Add({labels.row(int64_t(i)), size_t(labels.row_size())}, view.labels);
      for (int state = 0; state < kNumFaceStates; ++state) {
        const int64_t truth = view.states[size_t(state)];
        if (truth == kUnknownLabel) continue;
        const float* const scores = states.row(int64_t(i)) + 2 * state;
        ++sums.num_states;
        sums.wrong_states += (scores[1] > scores[0]) != (truth == 1);
      }
    }
  }
  return {{"nme_percent", 100 * sums.error / double(sums.num_faces)},
          {"eyes_nme_percent", 100 * sums.eyes / double(sums.num_faces)},
          {"mean_iou_percent", 100 * sums.labels.mean_iou()},
          {"state_errors_percent", 100 * double(sums.wrong_states) / double(std::max<int64_t>(1, sums.num_states))}};
}

}  // namespace daumier::portrait
