#pragma once
#include "rig/morph_targets.h"
#include "rig/weights_clip.h"

#include <array>
#include <string_view>

namespace daumier::rig {

/// Which order and spelling of targets a program expects.
enum class NamePreset {
  kArkit,          ///< Apple's order: eyeBlinkLeft, jawLeft.
  kArkitSides,     ///< Apple's order: eyeBlink_L, jawLeft.
  kUnreal,         ///< Apple's order: EyeBlinkLeft, JawLeft.
  kReadyPlayerMe,  ///< Visemes, then Apple's order, then the others: jawOpen.
  kVrm,            ///< Apple's order: jawOpen, as its expressions refer to targets by index.
  kMediaPipe,  ///< `_neutral`, which moves nothing, then MediaPipe's order, so that its index is that of the target.
};

struct NamedPreset {
  std::string_view name;
  NamePreset preset;
};
/// The words of the command line.
inline constexpr std::array<NamedPreset, 6> kNamePresets = {{{"arkit", NamePreset::kArkit},
                                                             {"arkit_lr", NamePreset::kArkitSides},
                                                             {"unreal", NamePreset::kUnreal},
                                                             {"rpm", NamePreset::kReadyPlayerMe},
                                                             {"vrm", NamePreset::kVrm},
                                                             {"mediapipe", NamePreset::kMediaPipe}}};

/// Targets in the order and spelling of a preset: ARKit's, in any spelling and order, then the others unchanged; of
/// kReadyPlayerMe those before them whose names begin with `viseme_`. Targets
/// of ARKit that are absent stay absent.
MorphTargets InPreset(const MorphTargets& targets, NamePreset preset);
/// A clip with the same spelling. Its eyes keep their turns, which EyeTurns finds by ARKit's own spelling alone.
WeightsClip InPreset(const WeightsClip& clip, NamePreset preset);

}  // namespace daumier::rig
