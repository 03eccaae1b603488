#include "systems/sketch/train/parser_recipe.h"

#include "core/error.h"
#include "core/evenly_spaced.h"
#include "losses/heat_map_loss.h"
#include "losses/label_loss.h"
#include "losses/state_loss.h"
#include "systems/sketch/parser_counts.h"
#include "systems/sketch/train/parser_network.h"
#include "tensor/array.h"
#include "tensor/autocast.h"

#include <algorithm>
#include <numeric>

namespace daumier::sketch {
namespace {

static_assert(datasets::kUnknownClass == losses::kNoLabel);

constexpr int kValidationBlock = 16;

torch::Tensor ClassWeights(const ParserLossOptions& options) {
  using enum faces::LineLabel;
  std::vector<float> weights(size_t(faces::kNumLineLabels), float(options.part_class_weight));
  weights[size_t(kSilhouette)] = 1;
  weights[size_t(kWrinkle)] = 1;
  weights[size_t(kHair)] = float(options.hair_class_weight);
  weights[size_t(kNeck)] = weights[size_t(kOther)] = float(options.other_class_weight);
  return torch::tensor(weights);
}

}  // namespace

std::vector<datasets::StyledSource> SourcesOf(const ParserSketches& sketches, const std::vector<int>& faces) {
  std::vector<datasets::StyledSource> sources = {{sketches.sketches, faces}};
  if (sketches.profiles == nullptr) return sources;
  datasets::StyledSource& profiles = sources.emplace_back(datasets::StyledSource{*sketches.profiles, {}});
  for (size_t i = 0; i < faces.size(); i += kProfileEvery) profiles.faces.push_back(faces[i]);
  return sources;
}

datasets::StyledSides SidesOf(const ParserNetworkOptions& options) {
  return {options.resolution, options.map_side(), options.label_side()};
}

ParserRecipe::ParserRecipe(const ParserTrainingOptions& options, const ParserSketches& sketches,
                           const std::vector<int>& training, const std::vector<int>& validation, torch::Device device)
    : options_(options),
      training_(SourcesOf(sketches, training), options.drawings, options.seed, SidesOf(options.network)),
      validation_(SourcesOf(sketches, EvenlySpaced(validation, options.validation.samples)), options.drawings,
                  options.seed + 1, SidesOf(options.network)),
      device_(device),
      network_(MakeParserNetwork(options.network)),
      class_weights_(ClassWeights(options.loss).to(device)),
      state_weights_(torch::tensor({1.0F, 1.0F, 1.0F, float(options.loss.view_weight)}).to(device)) {
  DAUMIER_CHECK(training_.size() > 0 && validation_.size() > 0,
                "a training needs training and validation faces, here {} and {}: see split.validation and split.test",
                training_.size(), validation_.size());
  network_->to(device_);
}

train::LossTerms ParserRecipe::Loss(const train::Batch& batch) {
  const models::HeatMapOutputs outputs = network_->forward(batch.at("pictures"));
  const tensor::Autocast full(device_, false);
  const auto exact = [](const torch::Tensor& scores) { return scores.to(torch::kFloat32); };
  const torch::Tensor points = losses::HeatMapLoss(exact(outputs.heat_maps), batch.at("points"), batch.at("weights"),
                                                   options_.network.deviation);
  const torch::Tensor labels = losses::LabelLoss(exact(outputs.labels), batch.at("labels"), class_weights_);
  const torch::Tensor states =
      losses::StateLoss(exact(outputs.states), network_->options().states, batch.at("states"), state_weights_);
  return {points + options_.loss.label_weight * labels + options_.loss.state_weight * states,
          {{"heat_maps", points}, {"labels", labels}, {"states", states}}};
}

std::map<std::string, double> ParserRecipe::Validate() {
  ParserCounts counts;
  for (int begin = 0; begin < validation_.size(); begin += kValidationBlock) {
    std::vector<int> block(size_t(std::min(kValidationBlock, validation_.size() - begin)));
    std::iota(block.begin(), block.end(), begin);
    SampleBatch batch = validation_.Get(block, 0);
    const models::HeatMapOutputs outputs =
        network_->forward(tensor::TakeTensor(FloatArray(batch.arrays.at("pictures"))).to(device_));
    counts.Add(batch,
               {tensor::CopyToArray<float>(outputs.heat_maps), tensor::CopyToArray<float>(outputs.labels),
                tensor::CopyToArray<float>(outputs.states)},
               options_.network);
  }
  return {{"nme_percent", 100 * counts.mean_error()},
          {"labels_percent", 100 * counts.labels.balanced_accuracy()},
          {"mouth_percent", 100 * counts.mouth.balanced_accuracy()},
          {"eyes_percent", 100 * counts.eyes.balanced_accuracy()},
          {"view_percent", 100 * counts.view.balanced_accuracy()}};
}

}  // namespace daumier::sketch
