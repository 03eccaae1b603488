#pragma once
#include "datasets/styles/styled_dataset.h"
#include "models/heat_map_unet.h"
#include "systems/sketch/parser_options.h"
#include "train/recipe.h"

#include <map>
#include <string>
#include <vector>

namespace daumier::sketch {

/// Trains the parser of drawings on sketches of training faces, drawn in another style in each epoch:
///   losses::HeatMapLoss + label_weight LabelLoss + state_weight StateLoss.
/// Validation reads fixed drawings of the validation faces and reports nme_percent (ErrorsOfPoints::all),
/// labels_percent, mouth_percent, eyes_percent and view_percent (balanced accuracies).
class ParserRecipe : public train::Recipe {
 public:
  /// training, validation: faces of the sketches. Draws the first weights from LibTorch's CPU generator. @throws Error if
  /// there is no face of either kind, or as StyledDataset.
  ParserRecipe(const ParserTrainingOptions& options, const ParserSketches& sketches, const std::vector<int>& training,
               const std::vector<int>& validation, torch::Device device);

  torch::nn::Module& module() override { return *network_; }
  torch::Device device() const override { return device_; }
  int num_samples() const override { return training_.size(); }
  SampleBatch Read(std::span<const int> samples, int64_t epoch) const override { return training_.Get(samples, epoch); }
  train::LossTerms Loss(const train::Batch& batch) override;
  std::map<std::string, double> Validate() override;
  std::string metric() const override { return "nme_percent"; }

  const models::HeatMapUnet& network() const { return network_; }

 private:
  const ParserTrainingOptions options_;
  datasets::StyledDataset training_, validation_;
  torch::Device device_;
  models::HeatMapUnet network_;
  torch::Tensor class_weights_, state_weights_;
};

/// The sketches of these faces, and profiles of some of them.
std::vector<datasets::StyledSource> SourcesOf(const ParserSketches& sketches, const std::vector<int>& faces);

/// The sides of what a network reads and learns.
datasets::StyledSides SidesOf(const ParserNetworkOptions& options);

}  // namespace daumier::sketch
