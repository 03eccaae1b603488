#include "rig/visemes.h"

#include <algorithm>

namespace daumier::rig {
namespace {

/// The parts, where a name that ends in "*" is that of the left and that of the right side.
Viseme MakeViseme(std::string_view name, std::initializer_list<VisemePart> parts) {
  static constexpr std::string_view kBothSides[][3] = {
      {"mouthPress*", "mouthPressLeft", "mouthPressRight"},
      {"mouthUpperUp*", "mouthUpperUpLeft", "mouthUpperUpRight"},
      {"mouthLowerDown*", "mouthLowerDownLeft", "mouthLowerDownRight"},
      {"mouthSmile*", "mouthSmileLeft", "mouthSmileRight"},
      {"mouthStretch*", "mouthStretchLeft", "mouthStretchRight"},
  };
  Viseme viseme{name, {}};
  for (const VisemePart& part : parts) {
    const auto both = std::ranges::find(kBothSides, part.expression, [](const auto& row) { return row[0]; });
    if (both == std::end(kBothSides)) {
      viseme.parts.push_back(part);
    } else {
      viseme.parts.push_back({(*both)[1], part.weight});
      viseme.parts.push_back({(*both)[2], part.weight});
    }
  }
  return viseme;
}

}  // namespace

std::span<const Viseme> Visemes() {
  static const std::vector<Viseme> visemes = {
      MakeViseme("viseme_sil", {}),
      MakeViseme("viseme_PP", {{"mouthPress*", 0.6f}, {"mouthRollLower", 0.3f}, {"mouthRollUpper", 0.3f}}),
      MakeViseme("viseme_FF",
                 {{"mouthRollLower", 0.5f}, {"mouthUpperUp*", 0.25f}, {"mouthShrugLower", 0.3f}, {"jawOpen", 0.05f}}),
      MakeViseme("viseme_TH",
                 {{"jawOpen", 0.15f}, {"tongueOut", 0.5f}, {"mouthLowerDown*", 0.15f}, {"mouthUpperUp*", 0.1f}}),
      MakeViseme("viseme_DD",
                 {{"jawOpen", 0.2f}, {"tongueOut", 0.2f}, {"mouthLowerDown*", 0.2f}, {"mouthUpperUp*", 0.1f}}),
      MakeViseme("viseme_kk", {{"jawOpen", 0.25f}, {"mouthLowerDown*", 0.2f}, {"mouthUpperUp*", 0.1f}}),
      MakeViseme("viseme_CH", {{"mouthFunnel", 0.6f}, {"mouthPucker", 0.25f}, {"jawOpen", 0.15f}}),
      MakeViseme("viseme_SS", {{"mouthStretch*", 0.3f},
                               {"mouthSmile*", 0.15f},
                               {"mouthLowerDown*", 0.2f},
                               {"mouthUpperUp*", 0.1f},
                               {"jawOpen", 0.08f}}),
      MakeViseme("viseme_nn", {{"jawOpen", 0.15f}, {"tongueOut", 0.15f}, {"mouthLowerDown*", 0.15f}}),
      MakeViseme("viseme_RR", {{"mouthPucker", 0.4f}, {"mouthFunnel", 0.3f}, {"jawOpen", 0.15f}}),
      MakeViseme("viseme_aa", {{"jawOpen", 0.65f}, {"mouthLowerDown*", 0.15f}, {"mouthUpperUp*", 0.1f}}),
      MakeViseme("viseme_E",
                 {{"jawOpen", 0.35f}, {"mouthStretch*", 0.3f}, {"mouthSmile*", 0.25f}, {"mouthLowerDown*", 0.15f}}),
      MakeViseme("viseme_I",
                 {{"jawOpen", 0.18f}, {"mouthSmile*", 0.4f}, {"mouthStretch*", 0.35f}, {"mouthLowerDown*", 0.15f}}),
      MakeViseme("viseme_O", {{"jawOpen", 0.45f}, {"mouthFunnel", 0.6f}, {"mouthPucker", 0.3f}}),
      MakeViseme("viseme_U", {{"mouthPucker", 0.75f}, {"mouthFunnel", 0.45f}, {"jawOpen", 0.15f}})};
  return visemes;
}

std::span<const Viseme> ReadyPlayerMeExtras() {
  static const std::array<Viseme, kNumReadyPlayerMeExtras> extras = {
      MakeViseme("mouthOpen", {{"jawOpen", 0.5f}}), MakeViseme("mouthSmile", {{"mouthSmile*", 0.8f}}),
      MakeViseme("eyesClosed", {{"eyeBlink*", 1.0f}}), MakeViseme("eyesLookUp", {{"eyeLookUp*", 1.0f}}),
      MakeViseme("eyesLookDown", {{"eyeLookDown*", 1.0f}})};
  return extras;
}

MorphTargets MixedTargets(const MorphTargets& expressions, std::span<const Viseme> mixed) {
  MorphTargets targets;
  targets.offsets = Eigen::MatrixXf::Zero(expressions.offsets.rows(), std::ssize(mixed));
  for (const Viseme& viseme : mixed) {
    auto column = targets.offsets.col(targets.num_targets());
    for (const VisemePart& part : viseme.parts) {
      const auto found = std::ranges::find(expressions.names, part.expression);
      if (found != expressions.names.end())
        column += part.weight * expressions.offsets.col(found - expressions.names.begin());
    }
    targets.names.emplace_back(viseme.name);
  }
  return targets;
}

MorphTargets VisemeTargets(const MorphTargets& expressions) {
  return MixedTargets(expressions, Visemes());
}

}  // namespace daumier::rig
