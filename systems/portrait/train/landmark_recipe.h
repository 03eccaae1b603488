#pragma once
#include "models/heat_map_unet.h"
#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_options.h"
#include "systems/portrait/landmark_sample.h"
#include "train/recipe.h"

#include <vector>

namespace daumier::portrait {

/// Trains the network of faces on crops and scenes of training samples, which vary from epoch to epoch:
///   losses::HeatMapLoss + label_weight LabelLoss + state_weight StateLoss of the crops
///   + score_weight and box_weight of losses::BoxLoss of crops and scenes together.
/// Batch norm sees crops and scenes in one batch. Validation sees upright crops of the validation samples, without
/// augmentation, and reports nme_percent (mean error of the 68 landmarks over the distance of the outer eye corners),
/// eyes_nme_percent, mean_iou_percent of the labels, and state_errors_percent of the known states. Sources have to outlive
/// it.
class LandmarkRecipe : public train::Recipe {
 public:
  /// training, validation: samples of `source`. Draws the first weights from LibTorch's CPU generator.
  /// @throws Error if there is no sample of either kind.
  LandmarkRecipe(const LandmarkTrainingOptions& options, const LandmarkSource& source, std::vector<int> training,
                 std::vector<int> validation, torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return int(training_.size()); }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override;
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "nme_percent"; }

  const models::HeatMapUnet& network() const { return network_; }

 private:
  const LandmarkTrainingOptions options_;
  const LandmarkSource& source_;
  const std::vector<int> training_, validation_;
  torch::Device device_;
  models::HeatMapUnet network_;
  torch::Tensor class_weights_, state_weights_;
};

}  // namespace daumier::portrait
