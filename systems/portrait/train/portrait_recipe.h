#pragma once
#include "systems/portrait/portrait_measures.h"
#include "systems/portrait/train/portrait_loss.h"
#include "systems/portrait/train/portrait_network.h"
#include "systems/portrait/train/portrait_samples.h"
#include "train/recipe.h"

#include <memory>

namespace daumier::portrait {

/// The portraits of a training.
struct PortraitSets {
  std::vector<int> train, validation;  ///< Images.
  const datasets::PortraitDatabase* real = nullptr;
};

/// A network that regresses the coefficients of portraits by PortraitLoss, self-supervised through the renderer, and
/// with supervision where its weights are above 0. Validation reports, over validation portraits without jitter:
/// vertex_error_mm (ShapeMeasure), landmark_error (a share of the eyes' distance) and angle_error_degrees, the mean
/// difference of the viewed rotations. Databases have to outlive it.
class PortraitRecipe : public train::Recipe {
 public:
  /// Draws the first weights from LibTorch's CPU generator. @throws Error if a set is empty, the portraits were stored
  /// without vertices, or the device is not the CPU while the loss renders.
  PortraitRecipe(const PortraitTrainingOptions& options, const faces::MorphableModel& model,
                 const datasets::PortraitDatabase& portraits, const PortraitSets& sets, torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override { return training_.Get(samples, epoch); }
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "vertex_error_mm"; }

  PortraitNetwork& network() { return network_; }
  const PortraitLoss& loss() const { return loss_; }

 private:
  const PortraitTrainingOptions options_;
  torch::Device device_;
  CropSamples training_, validation_;
  PortraitLoss loss_;
  ShapeMeasure measure_;
  PortraitNetwork network_{nullptr};
  SampleBatch validation_batch_;
};

}  // namespace daumier::portrait
