#pragma once
#include "gltf/glb_builder.h"
#include "rig/weights_clip.h"

#include <string>
#include <vector>

namespace daumier::gltf {

/// The keys of a clip as a file has them: all parts at the same times, every key with all weights.
struct HeadAnimation {
  std::vector<float> times;             ///< K, s, ascending from 0.
  FloatRows weights;                    ///< K x T, in the order of the head's targets, 0 .. 1.
  FloatRows head, right_eye, left_eye;  ///< K x 4: quaternions (x, y, z, w) of unit length.
  double lead_in_seconds = 0;           ///< By how much the clip's frames are later than in the clip.
};

/// How long a file shows the neutral pose first: programs that open it at their first frame then show the neutral pose.
inline constexpr double kNeutralSeconds = 0.05;

/// The clip for a head with `targets`. Where it does not hold the neutral pose for kNeutralSeconds from its start, two
/// neutral keys precede it, kNeutralSeconds apart, and its first frame follows after as long again. Eyes turn as
/// rig::EyeTurns. No keys if the clip has no frames.
/// @throws Error if the clip names a target twice or one that the head does not have, if a weight is outside 0 .. 1 or
/// not finite, if a turn is not finite, if sizes disagree, or if frames_per_second is not positive.
HeadAnimation ResolveClip(const rig::WeightsClip& clip, const std::vector<std::string>& targets);

}  // namespace daumier::gltf
