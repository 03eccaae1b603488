#pragma once
#include <torch/nn/module.h>
#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/nn/pimpl.h>

#include <numeric>
#include <vector>

namespace daumier::models {

/// Which outputs a HeatMapUnet has, and its size.
struct HeatMapUnetOptions {
  int channels = 3;               ///< Of the picture.
  int width = 16;                 ///< Channels at half the side; 2, 4 and 8 times as many at the next three sides.
  int point_width = 48;           ///< Channels at a quarter of the side, from which heat maps are made.
  int num_points = 68;            ///< L
  int num_classes = 8;            ///< C, of a pixel.
  std::vector<int> states = {2};  ///< Number of classes of each state of the whole picture.
  bool finds_boxes = true;        ///< Whether there is a search head.

  /// S: scores of all states' classes in a row.
  int num_state_scores() const { return std::accumulate(states.begin(), states.end(), 0); }
};

/// Scores before any softmax or sigmoid, of B pictures with sides H and W.
struct HeatMapOutputs {
  torch::Tensor heat_maps;  ///< (B, L, H / 4, W / 4): where each point is.
  torch::Tensor labels;     ///< (B, C, H / 2, W / 2): the class of each pixel.
  torch::Tensor states;     ///< (B, S)
  /// (B, 5, H / 8, W / 8): whether the centre of a box lies in a cell; the centre's offset from the cell's centre, x
  /// and y, in cells; the logarithms of width and height in cells. Undefined without a search head.
  torch::Tensor boxes;
};

/// Features that the heads read: maps at a half, a quarter, an eighth and a sixteenth of the side, and the eighth again
/// once it has seen the sixteenth.
struct HeatMapFeatures {
  torch::Tensor half, quarter, eighth, sixteenth, context;
};

/// A U-Net [Ronneberger et al. 2015] that parses a picture of one thing: heat maps of points, classes of pixels, states
/// of the whole, and boxes of such things in a larger picture. Residual blocks [He et al. 2016] go down to a sixteenth of
/// the side; on the way up the maps are enlarged (nearest), brought to the width of the next one by a 1 x 1
/// convolution and added to it. All convolutions are 3 x 3 with batch norm and ReLU but those of short cuts and heads.
/// Numbers of 0..1 come in; they are shifted and scaled to -2..2 within.
class HeatMapUnetImpl : public torch::nn::Module {
 public:
  /// Draws weights from LibTorch's CPU generator. Heat maps and boxes begin flat: their heads' weights are small, and the
  /// score of a box begins at -4. @throws Error if width or point_width is no multiple of 8, or a count is below 1.
  explicit HeatMapUnetImpl(const HeatMapUnetOptions& options);

  /// pictures: (B, channels, H, W), H and W multiples of 16. @throws Error if the shape disagrees.
  HeatMapFeatures Features(const torch::Tensor& pictures);
  /// (B, 5, H / 8, W / 8). @throws Error without a search head.
  torch::Tensor Boxes(const HeatMapFeatures& features);
  /// All but the boxes.
  HeatMapOutputs Parse(const HeatMapFeatures& features);
  /// All outputs.
  HeatMapOutputs forward(const torch::Tensor& pictures);

  const HeatMapUnetOptions& options() const { return options_; }
  int64_t num_parameters() const;

 private:
  void AddBoxHead();

  HeatMapUnetOptions options_;
  torch::nn::Sequential half_, quarter_, eighth_, sixteenth_;
  torch::nn::Conv2d to_eighth_{nullptr}, to_quarter_{nullptr}, of_quarter_{nullptr}, to_half_{nullptr};
  torch::nn::Sequential context_, points_, pixels_, box_features_;
  torch::nn::Conv2d heat_map_head_{nullptr}, label_head_{nullptr}, box_head_{nullptr};
  torch::nn::Linear state_features_{nullptr}, state_head_{nullptr};
};
TORCH_MODULE(HeatMapUnet);

}  // namespace daumier::models
