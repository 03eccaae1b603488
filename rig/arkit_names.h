#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The 52 names of ARKit's face tracking, which game engines, web players and face trackers share.
namespace daumier::rig {

inline constexpr int kNumArkitNames = 52;

/// In the order of Apple's documentation, which is also that of Live Link's packets: eyeBlinkLeft (0) .. tongueOut (51).
/// Left is the character's own left, +x.
std::span<const std::string_view, kNumArkitNames> ArkitNames();

enum class ArkitSpelling {
  kCamelCase,   ///< eyeBlinkLeft, jawLeft: the names in ArkitNames().
  kSides,       ///< eyeBlink_L, jawLeft: a side is a suffix, but in jawLeft, jawRight, mouthLeft and mouthRight.
  kPascalCase,  ///< EyeBlinkLeft, JawLeft.
};

/// One of the 52 names in a spelling. @throws Error unless 0 <= index < 52.
std::string SpellArkitName(int index, ArkitSpelling spelling);

/// The index of a name in any of the spellings, upper and lower case alike; none if it is no such name.
std::optional<int> FindArkitName(std::string_view name);

/// The index of the name of the other side; its own where there is none. @throws Error unless 0 <= index < 52.
int ArkitPartner(int index);

/// Names of the shapes of ICT-FaceKit whose sum is that expression: one, or for browInnerUp and cheekPuff that of each
/// side; none for tongueOut. @throws Error unless 0 <= index < 52.
std::vector<std::string> IctShapesOf(int index);

/// MediaPipe's order: the index in ArkitNames() of its categories 1 .. 51. Its category 0 is `_neutral`; it has no
/// tongueOut.
const std::array<int, kNumArkitNames - 1>& MediaPipeOrder();

}  // namespace daumier::rig
