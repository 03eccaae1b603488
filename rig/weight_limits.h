#pragma once
#include "rig/weights_clip.h"

#include <string_view>
#include <vector>

namespace daumier::rig {

/// weight of `target` <= base + sum of factor x weight of `of`, and not below 0. By ARKit's names.
struct WeightLimit {
  struct Term {
    std::string_view of;
    float factor;
  };
  std::string_view target;
  float base;
  std::vector<Term> terms;
};

/// Targets add up, and some close or open the same opening. Within these limits lids and lips meet and do not cross, and a
/// jaw opens no farther than jawOpen alone: eyeBlink* <= BlinkLimit(eyeSquint*, eyeLookDown*) of the same side, jawOpen <= 1 -
/// kTongueOpens tongueOut, mouthClose <= jawOpen. In an order in which each may be lowered once.
const std::vector<WeightLimit>& WeightLimits();

/// Lowers the weights that are beyond their limits. Names by every spelling of FindArkitName; a target that the clip does
/// not name counts as 0.
void LimitWeights(WeightsClip& clip);

}  // namespace daumier::rig
