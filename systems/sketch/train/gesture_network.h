#pragma once
#include "systems/sketch/gesture_network_options.h"

#include <torch/nn/modules/container/sequential.h>

namespace daumier::sketch {

/// (B, 1, S, S) pictures of strokes -> (B, 11) scores of the ten gestures and of none, without softmax. Draws weights
/// from LibTorch's CPU generator.
///   paper    [Han et al. 2017, section 5.2] S = 256: convolutions 11 x 11 x 32, 5 x 5 x 64 and 3 x 3 x 16, each with
///            ReLU and a 3 x 3 maximum, fully connected 256 and 11. Strides and padding are not printed: convolutions
///            have none, maxima do not overlap.
///   compact  S = 80: 5 x 5 x 16 of stride 2, 3 x 3 x 32, 3 x 3 x 48, 3 x 3 x 64, each with batch norm and ReLU, the
///            last three with a 2 x 2 maximum, fully connected 96 and 11.
torch::nn::Sequential MakeGestureNetwork(const GestureNetworkOptions& options);

int64_t NumParameters(const torch::nn::Module& module);

}  // namespace daumier::sketch
