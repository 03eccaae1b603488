#pragma once
#include <torch/types.h>

#include <utility>
#include <vector>

namespace daumier::losses {

/// Pairs of landmarks of which each is one above an opening and one below it.
using LandmarkPairs = std::vector<std::pair<int, int>>;

/// Of the 68 landmarks: upper and lower lid (two pairs an eye), upper and lower inner lip (three pairs).
LandmarkPairs EyelidPairs();
LandmarkPairs LipPairs();

/// Difference of openings [Feng et al. 2021]: mean over batch and pairs of
///   sqrt(|(p_a - p_b) - (q_a - q_b)|^2 + 1e-4) - 1e-2
/// for the landmarks a, b of a pair. It does not change when all landmarks move together, so that an error of pose does
/// not hide a wink. predicted p, target q: (B, L, 2) in pixels. Zero iff the openings agree.
/// @throws daumier::Error if a shape disagrees or a landmark of a pair is not in 0 .. L - 1.
torch::Tensor OpeningLoss(const torch::Tensor& predicted, const torch::Tensor& target, const LandmarkPairs& pairs);

}  // namespace daumier::losses
