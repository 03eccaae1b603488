#include "systems/sketch/train/gesture_recipe.h"

#include "core/error.h"
#include "losses/state_loss.h"
#include "systems/sketch/gesture_counts.h"
#include "tensor/array.h"
#include "tensor/autocast.h"

#include <algorithm>
#include <numeric>

namespace daumier::sketch {
namespace {

constexpr int kGestureBlock = 256;

}  // namespace

GestureRecipe::GestureRecipe(const GestureTrainingOptions& options, const datasets::GestureDatabase& database,
                             const datasets::GestureSplit& split, torch::Device device)
    : training_(database, split.train, options.network.raster()),
      validation_(database, split.validation, options.network.raster()),
      device_(device),
      network_(MakeGestureNetwork(options.network)) {
  DAUMIER_CHECK(training_.size() > 0 && validation_.size() > 0,
                "a training needs strokes for training and validation, here {} and {}: see split.validation and "
                "split.test",
                training_.size(), validation_.size());
  network_->to(device_);
}

train::LossTerms GestureRecipe::Loss(const train::Batch& batch) {
  const torch::Tensor scores = network_->forward(batch.at("pictures"));
  const tensor::Autocast full(device_, false);
  const torch::Tensor loss = losses::StateLoss(scores.to(torch::kFloat32), {kNumGestureClasses},
                                               batch.at("gestures").unsqueeze(1), torch::ones({1}, device_));
  return {loss, {{"gestures", loss}}};
}

std::map<std::string, double> GestureRecipe::Validate() {
  int num_wrong = 0;
  GestureCounts counts;
  for (int begin = 0; begin < validation_.size(); begin += kGestureBlock) {
    std::vector<int> block(size_t(std::min(kGestureBlock, validation_.size() - begin)));
    std::iota(block.begin(), block.end(), begin);
    SampleBatch batch = validation_.Get(block);
    const auto scores = tensor::CopyToArray<float>(
        network_->forward(tensor::TakeTensor(std::move(batch.arrays.at("pictures"))).to(device_)));
    for (size_t i = 0; i < block.size(); ++i) {
      const std::span<const float> of_stroke(scores.row(int64_t(i)), size_t{kNumGestureClasses});
      const int64_t truth = batch.indices.at("gestures").values[i];
      num_wrong += std::ranges::max_element(of_stroke) - of_stroke.begin() != truth;
      counts.Add(datasets::Gesture(truth), DecideGesture(of_stroke, {}));
    }
  }
  return {{"error_percent", 100.0 * num_wrong / validation_.size()},
          {"gesture_error_percent", 100 * (1 - counts.accuracy())}};
}

}  // namespace daumier::sketch
