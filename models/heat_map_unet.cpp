#include "models/heat_map_unet.h"

#include "core/error.h"
#include "models/sketch_trunks.h"
#include "tensor/shape.h"
#include "tensor/torch_version.h"

#include <torch/nn/functional/upsampling.h>
#include <torch/nn/modules/activation.h>
#include <torch/nn/modules/batchnorm.h>

#include <algorithm>

namespace daumier::models {
namespace {

namespace nn = torch::nn;

constexpr int kBlock = 8;  // Channels that oneDNN computes at a time.
constexpr double kMean = 0.5, kDeviation = 0.25;
constexpr double kHeadDeviation = 0.01;  // Of the first weights of heads of maps.
constexpr double kNoBox = -4;            // The first score of a box: about one cell in fifty.

nn::Conv2dOptions Kernel(int from, int to, int side, int stride, bool bias) {
  return nn::Conv2dOptions(from, to, side).stride(stride).padding(side / 2).bias(bias);
}

/// 3 x 3, batch norm, ReLU.
void PushNormalisedMap(nn::Sequential& layers, int from, int to, int stride = 1) {
  layers->push_back(nn::Conv2d(Kernel(from, to, 3, stride, false)));
  layers->push_back(nn::BatchNorm2d(to));
  layers->push_back(nn::ReLU(nn::ReLUOptions(/*inplace=*/true)));
}

nn::Sequential NormalisedMap(int from, int to) {
  nn::Sequential layers;
  PushNormalisedMap(layers, from, to);
  return layers;
}

nn::Conv2d Pointwise(int from, int to) {
  return nn::Conv2d(Kernel(from, to, 1, 1, true));
}

/// A head of maps with small weights and the given bias.
nn::Conv2d Head(int from, int to) {
  nn::Conv2d head = Pointwise(from, to);
  const at::NoGradGuard no_grad;
  head->weight.normal_(0, kHeadDeviation);
  head->bias.zero_();
  return head;
}

torch::Tensor Enlarged(const torch::Tensor& maps) {
  return nn::functional::interpolate(
      maps, nn::functional::InterpolateFuncOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest));
}

void CheckOptions(const HeatMapUnetOptions& options) {
  DAUMIER_CHECK(options.width >= kBlock && options.width % kBlock == 0 && options.point_width >= kBlock &&
                    options.point_width % kBlock == 0,
                "the widths of the network are {} and {}, expected multiples of {}", options.width, options.point_width,
                kBlock);
  DAUMIER_CHECK(options.channels >= 1 && options.num_points >= 1 && options.num_classes >= 1 &&
                    !options.states.empty() && *std::ranges::min_element(options.states) >= 2,
                "the network reads {} channels and returns {} points, {} classes and {} states, expected at least one "
                "of each and two classes of a state",
                options.channels, options.num_points, options.num_classes, options.states.size());
}

}  // namespace

HeatMapUnetImpl::HeatMapUnetImpl(const HeatMapUnetOptions& options) : options_(options) {
  CheckOptions(options);
  const int w = options.width, points = options.point_width;
  half_ = register_module("half", nn::Sequential());
  PushNormalisedMap(half_, options.channels, w, 2);
  PushNormalisedMap(half_, w, w);
  quarter_ = register_module("quarter", nn::Sequential(ResidualBlock(w, 2 * w, 2)));
  eighth_ = register_module("eighth", nn::Sequential(ResidualBlock(2 * w, 4 * w, 2), ResidualBlock(4 * w, 4 * w, 1)));
  sixteenth_ =
      register_module("sixteenth", nn::Sequential(ResidualBlock(4 * w, 8 * w, 2), ResidualBlock(8 * w, 8 * w, 1)));
  to_eighth_ = register_module("to_eighth", Pointwise(8 * w, 4 * w));
  context_ = register_module("context", NormalisedMap(4 * w, 4 * w));
  to_quarter_ = register_module("to_quarter", Pointwise(4 * w, points));
  of_quarter_ = register_module("of_quarter", Pointwise(2 * w, points));
  points_ = register_module("points", NormalisedMap(points, points));
  heat_map_head_ = register_module("heat_map_head", Head(points, options.num_points));
  to_half_ = register_module("to_half", Pointwise(points, w));
  pixels_ = register_module("pixels", NormalisedMap(w, w));
  label_head_ = register_module("label_head", Head(w, options.num_classes));
  state_features_ = register_module("state_features", nn::Linear(16 * w, 4 * w));
  state_head_ = register_module("state_head", nn::Linear(4 * w, options.num_state_scores()));
  if (options.finds_boxes) AddBoxHead();
  StoreChannelsLast(*this);
}

void HeatMapUnetImpl::AddBoxHead() {
  const int w = options_.width;
  box_features_ = register_module("box_features", NormalisedMap(4 * w, 2 * w));
  box_head_ = register_module("box_head", Head(2 * w, 5));
  const at::NoGradGuard no_grad;
  box_head_->bias[0] = kNoBox;
}

HeatMapFeatures HeatMapUnetImpl::Features(const torch::Tensor& pictures) {
  tensor::CheckShape(pictures, {tensor::kAny, options_.channels, tensor::kAny, tensor::kAny}, "pictures");
  DAUMIER_CHECK(pictures.size(2) % 16 == 0 && pictures.size(3) % 16 == 0,
                "pictures are {} x {}, expected sides that are multiples of 16", pictures.size(2), pictures.size(3));
  HeatMapFeatures features;
  features.half = half_->forward((pictures - kMean) * (1 / kDeviation));
  features.quarter = quarter_->forward(features.half);
  features.eighth = eighth_->forward(features.quarter);
  features.sixteenth = sixteenth_->forward(features.eighth);
  features.context = context_->forward(features.eighth + Enlarged(to_eighth_->forward(features.sixteenth)));
  return features;
}

torch::Tensor HeatMapUnetImpl::Boxes(const HeatMapFeatures& features) {
  DAUMIER_CHECK(options_.finds_boxes, "the network has no search head");
  return box_head_->forward(box_features_->forward(features.context));
}

HeatMapOutputs HeatMapUnetImpl::Parse(const HeatMapFeatures& features) {
  HeatMapOutputs outputs;
  const torch::Tensor quarter =
      points_->forward(of_quarter_->forward(features.quarter) + Enlarged(to_quarter_->forward(features.context)));
  outputs.heat_maps = heat_map_head_->forward(quarter);
  outputs.labels = label_head_->forward(pixels_->forward(features.half + Enlarged(to_half_->forward(quarter))));
  const torch::Tensor deep = features.sixteenth;
  const torch::Tensor summary = torch::cat({deep.mean({2, 3}), deep.amax({2, 3})}, 1);
  outputs.states = state_head_->forward(state_features_->forward(summary).relu());
  return outputs;
}

HeatMapOutputs HeatMapUnetImpl::forward(const torch::Tensor& pictures) {
  const HeatMapFeatures features = Features(pictures);
  HeatMapOutputs outputs = Parse(features);
  if (options_.finds_boxes) outputs.boxes = Boxes(features);
  return outputs;
}

int64_t HeatMapUnetImpl::num_parameters() const {
  int64_t count = 0;
  for (const torch::Tensor& parameter : parameters()) count += parameter.numel();
  return count;
}

}  // namespace daumier::models
