#include "rig/arkit_names.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>

namespace daumier::rig {
namespace {

constexpr std::array<std::string_view, kNumArkitNames> kNames = {
    "eyeBlinkLeft",      "eyeLookDownLeft",    "eyeLookInLeft",
    "eyeLookOutLeft",    "eyeLookUpLeft",      "eyeSquintLeft",
    "eyeWideLeft",       "eyeBlinkRight",      "eyeLookDownRight",
    "eyeLookInRight",    "eyeLookOutRight",    "eyeLookUpRight",
    "eyeSquintRight",    "eyeWideRight",       "jawForward",
    "jawLeft",           "jawRight",           "jawOpen",
    "mouthClose",        "mouthFunnel",        "mouthPucker",
    "mouthLeft",         "mouthRight",         "mouthSmileLeft",
    "mouthSmileRight",   "mouthFrownLeft",     "mouthFrownRight",
    "mouthDimpleLeft",   "mouthDimpleRight",   "mouthStretchLeft",
    "mouthStretchRight", "mouthRollLower",     "mouthRollUpper",
    "mouthShrugLower",   "mouthShrugUpper",    "mouthPressLeft",
    "mouthPressRight",   "mouthLowerDownLeft", "mouthLowerDownRight",
    "mouthUpperUpLeft",  "mouthUpperUpRight",  "browDownLeft",
    "browDownRight",     "browInnerUp",        "browOuterUpLeft",
    "browOuterUpRight",  "cheekPuff",          "cheekSquintLeft",
    "cheekSquintRight",  "noseSneerLeft",      "noseSneerRight",
    "tongueOut"};

constexpr std::string_view kLeft = "Left", kRight = "Right";

std::string_view NameAt(int index) {
  DAUMIER_CHECK(index >= 0 && index < kNumArkitNames, "there is no ARKit name {}, they are 0 .. {}", index,
                kNumArkitNames - 1);
  return kNames[size_t(index)];
}

bool HasPartNamedAsSide(std::string_view stem) {
  return stem == "jaw" || stem == "mouth";
}

std::string Folded(std::string_view name) {
  std::string folded(name);
  for (char& c : folded) c = char(std::tolower(static_cast<unsigned char>(c)));
  return folded;
}

}  // namespace

std::span<const std::string_view, kNumArkitNames> ArkitNames() {
  return kNames;
}

std::string SpellArkitName(int index, ArkitSpelling spelling) {
  std::string name(NameAt(index));
  if (spelling == ArkitSpelling::kPascalCase) name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
  if (spelling != ArkitSpelling::kSides) return name;
  for (const std::string_view side : {kLeft, kRight}) {
    if (!name.ends_with(side)) continue;
    const std::string stem = name.substr(0, name.size() - side.size());
    return HasPartNamedAsSide(stem) ? name : stem + '_' + side[0];
  }
  return name;
}

std::optional<int> FindArkitName(std::string_view name) {
  static const std::map<std::string, int> indices = [] {
    std::map<std::string, int> result;
    for (int i = 0; i < kNumArkitNames; ++i) {
      result[Folded(kNames[size_t(i)])] = i;
      result[Folded(SpellArkitName(i, ArkitSpelling::kSides))] = i;
    }
    return result;
  }();
  const auto found = indices.find(Folded(name));
  return found == indices.end() ? std::nullopt : std::optional(found->second);
}

int ArkitPartner(int index) {
  const std::string_view name = NameAt(index);
  for (const auto& [side, other] : {std::pair(kLeft, kRight), std::pair(kRight, kLeft)}) {
    if (name.ends_with(side)) {
      return *FindArkitName(std::string(name.substr(0, name.size() - side.size())) + std::string(other));
    }
  }
  return index;
}

std::vector<std::string> IctShapesOf(int index) {
  const std::string_view name = NameAt(index);
  if (name == "tongueOut") return {};
  if (name == "browInnerUp" || name == "cheekPuff") return {std::string(name) + "_L", std::string(name) + "_R"};
  return {SpellArkitName(index, ArkitSpelling::kSides)};
}

const std::array<int, kNumArkitNames - 1>& MediaPipeOrder() {
  static const std::array<int, kNumArkitNames - 1> order = [] {
    std::array<int, kNumArkitNames - 1> indices{};  // tongueOut comes last and is left out.
    std::iota(indices.begin(), indices.end(), 0);
    std::ranges::sort(indices, {}, [](int i) { return kNames[size_t(i)]; });
    return indices;
  }();
  return order;
}

}  // namespace daumier::rig
