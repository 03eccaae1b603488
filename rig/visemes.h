#pragma once

#include "rig/morph_targets.h"

#include <span>
#include <string_view>
#include <vector>

/// The 15 mouth shapes of speech of Oculus LipSync, as combinations of the 52 ARKit expressions.
namespace daumier::rig {

inline constexpr int kNumVisemes = 15;

struct VisemePart {
  std::string_view expression;  ///< One of ArkitNames().
  float weight;
};

struct Viseme {
  std::string_view name;          ///< viseme_sil, viseme_PP ... viseme_U: the names of Ready Player Me.
  std::vector<VisemePart> parts;  ///< Empty for viseme_sil. Both sides of an expression have one weight.
};

/// In the order of Oculus. The weights are our own choice at full strength: a player that shows them at 0.6 to 0.9
/// articulates normally. Bilabials (PP) press and roll the lips of a shut jaw, without mouthClose, on which rigs
/// disagree; FF draws the lower lip under the teeth; TH, DD and nn show the tongue.
std::span<const Viseme> Visemes();

/// What Ready Player Me's avatars have in addition, in its order, with the weights that TalkingHead 1.7.0 mixes for heads
/// that lack them: mouthOpen, mouthSmile, eyesClosed, eyesLookUp, eyesLookDown.
inline constexpr int kNumReadyPlayerMeExtras = 5;
std::span<const Viseme> ReadyPlayerMeExtras();

/// A target for each of `mixed`, the sum of the named columns of `expressions`; an expression that it lacks moves nothing.
MorphTargets MixedTargets(const MorphTargets& expressions, std::span<const Viseme> mixed);

/// MixedTargets of Visemes().
MorphTargets VisemeTargets(const MorphTargets& expressions);

}  // namespace daumier::rig
