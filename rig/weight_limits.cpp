#include "rig/weight_limits.h"

#include "rig/arkit_names.h"
#include "rig/face_contact.h"

#include <algorithm>
#include <array>

namespace daumier::rig {

const std::vector<WeightLimit>& WeightLimits() {
  constexpr auto kSquint = float(-kSquintNarrows), kDown = float(-kLookDownNarrows);
  static const std::vector<WeightLimit> limits = {
      {"eyeBlinkLeft", 1, {{"eyeSquintLeft", kSquint}, {"eyeLookDownLeft", kDown}}},
      {"eyeBlinkRight", 1, {{"eyeSquintRight", kSquint}, {"eyeLookDownRight", kDown}}},
      {"jawOpen", 1, {{"tongueOut", float(-kTongueOpens)}}},
      {"mouthClose", 0, {{"jawOpen", 1}}}};
  return limits;
}

void LimitWeights(WeightsClip& clip) {
  std::array<int, kNumArkitNames> column;
  column.fill(-1);
  for (int t = 0; t < std::ssize(clip.names); ++t)
    if (const auto index = FindArkitName(clip.names[size_t(t)])) column[size_t(*index)] = t;
  const auto column_of = [&](std::string_view name) { return column[size_t(*FindArkitName(name))]; };
  for (const WeightLimit& limit : WeightLimits()) {
    const int target = column_of(limit.target);
    if (target < 0) continue;
    Eigen::VectorXf most = Eigen::VectorXf::Constant(clip.num_frames(), limit.base);
    for (const auto& [of, factor] : limit.terms)
      if (const int other = column_of(of); other >= 0) most += factor * clip.weights.col(other);
    clip.weights.col(target) = clip.weights.col(target).cwiseMin(most.cwiseMax(0.0f));
  }
}

}  // namespace daumier::rig
