#pragma once
#include "datasets/read/gesture_dataset.h"
#include "systems/sketch/gesture_options.h"
#include "systems/sketch/train/gesture_network.h"
#include "train/recipe.h"

#include <map>
#include <string>
#include <vector>

namespace daumier::sketch {

/// Trains the classifier of gestures: the mean cross-entropy of the eleven classes (losses::StateLoss). Validation
/// reports error_percent, the share of strokes of a wrong class, and gesture_error_percent, that of the ten gestures
/// alone, whatever the score of none.
class GestureRecipe : public train::Recipe {
 public:
  /// Draws the first weights from LibTorch's CPU generator. @throws Error if a subset has no stroke.
  GestureRecipe(const GestureTrainingOptions& options, const datasets::GestureDatabase& database,
                const datasets::GestureSplit& split, torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  SampleBatch Read(std::span<const int> samples, int64_t) const override { return training_.Get(samples); }
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "error_percent"; }

 private:
  datasets::GestureDataset training_, validation_;
  torch::Device device_;
  torch::nn::Sequential network_;
};

}  // namespace daumier::sketch
