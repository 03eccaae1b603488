#include "rig/demo_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace daumier::rig {
namespace {

constexpr double kSeconds = 5;

/// A rise over `ramp` seconds from `begin`, and a fall that ends at `end`.
struct DemoMove {
  std::string_view target;
  double begin, end, ramp, weight;
};
constexpr std::array kDemoMoves = {
    DemoMove{"eyeBlinkLeft", 0.2, 0.5, 0.12, 1},      DemoMove{"eyeBlinkRight", 0.2, 0.5, 0.12, 1},
    DemoMove{"jawOpen", 0.7, 1.4, 0.25, 0.7},         DemoMove{"mouthSmileLeft", 1.4, 2.4, 0.3, 0.8},
    DemoMove{"mouthSmileRight", 1.4, 2.4, 0.3, 0.8},  DemoMove{"cheekSquintLeft", 1.4, 2.4, 0.3, 0.4},
    DemoMove{"cheekSquintRight", 1.4, 2.4, 0.3, 0.4}, DemoMove{"eyeLookOutLeft", 2.4, 2.9, 0.12, 0.7},
    DemoMove{"eyeLookInRight", 2.4, 2.9, 0.12, 0.7},  DemoMove{"eyeLookInLeft", 2.8, 3.3, 0.12, 0.7},
    DemoMove{"eyeLookOutRight", 2.8, 3.3, 0.12, 0.7}, DemoMove{"eyeLookUpLeft", 3.2, 3.6, 0.12, 0.5},
    DemoMove{"eyeLookUpRight", 3.2, 3.6, 0.12, 0.5},  DemoMove{"browInnerUp", 3.2, 3.7, 0.15, 0.6},
    DemoMove{"browOuterUpLeft", 3.2, 3.7, 0.15, 0.6}, DemoMove{"browOuterUpRight", 3.2, 3.7, 0.15, 0.6},
    DemoMove{"eyeLookDownLeft", 3.6, 4.0, 0.12, 0.5}, DemoMove{"eyeLookDownRight", 3.6, 4.0, 0.12, 0.5},
};
constexpr double kNodBegin = 4.0, kNodEnd = 4.8, kNodAngle = 8 * std::numbers::pi / 180;

/// 0 .. 1, without a jump of speed at either end.
double Smooth(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

double WeightAt(const DemoMove& move, double seconds) {
  return move.weight * Smooth((seconds - move.begin) / move.ramp) * Smooth((move.end - seconds) / move.ramp);
}

/// Down and up again.
double PitchAt(double seconds) {
  const double share = std::clamp((seconds - kNodBegin) / (kNodEnd - kNodBegin), 0.0, 1.0);
  return kNodAngle * 0.5 * (1 - std::cos(2 * std::numbers::pi * share));
}

}  // namespace

WeightsClip DemoClip(const std::vector<std::string>& targets) {
  WeightsClip clip;
  const int num_frames = static_cast<int>(std::lround(kSeconds * clip.frames_per_second)) + 1;
  clip.names = targets;
  clip.weights = Eigen::MatrixXf::Zero(num_frames, std::ssize(targets));
  clip.head = Eigen::MatrixXf::Zero(num_frames, 3);
  for (int n = 0; n < num_frames; ++n) {
    const double seconds = n / clip.frames_per_second;
    for (const DemoMove& move : kDemoMoves) {
      const auto found = std::find(targets.begin(), targets.end(), move.target);
      if (found != targets.end()) clip.weights(n, found - targets.begin()) = float(WeightAt(move, seconds));
    }
    clip.head(n, 0) = float(PitchAt(seconds));
  }
  return clip;
}

}  // namespace daumier::rig
