#include "gltf/vrm_expressions.h"

#include "rig/visemes.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

namespace daumier::gltf {
namespace {

struct PartOfPreset {
  std::string_view target;  ///< "*" at its end: Left and Right.
  double weight;
};
struct VrmPreset {
  const char* name;
  std::vector<PartOfPreset> parts;
};

/// Feelings are mixtures of ours, at most as strong as a face shows them; blinks and looks are the targets.
const std::vector<VrmPreset>& VrmPresets() {
  static const std::vector<VrmPreset> kPresets = {
      {"happy", {{"mouthSmile*", 0.8}, {"cheekSquint*", 0.5}, {"eyeSquint*", 0.3}}},
      {"angry",
       {{"browDown*", 0.9}, {"noseSneer*", 0.4}, {"mouthFrown*", 0.4}, {"mouthPress*", 0.3}, {"eyeSquint*", 0.4}}},
      {"sad", {{"browInnerUp", 0.9}, {"mouthFrown*", 0.7}, {"mouthShrugLower", 0.3}, {"eyeSquint*", 0.2}}},
      {"relaxed", {{"mouthSmile*", 0.35}, {"eyeBlink*", 0.2}}},
      {"surprised", {{"browInnerUp", 0.9}, {"browOuterUp*", 0.8}, {"eyeWide*", 0.8}, {"jawOpen", 0.35}}},
      {"blink", {{"eyeBlink*", 1}}},
      {"blinkLeft", {{"eyeBlinkLeft", 1}}},
      {"blinkRight", {{"eyeBlinkRight", 1}}},
      {"lookUp", {{"eyeLookUp*", 1}}},
      {"lookDown", {{"eyeLookDown*", 1}}},
      {"lookLeft", {{"eyeLookOutLeft", 1}, {"eyeLookInRight", 1}}},
      {"lookRight", {{"eyeLookInLeft", 1}, {"eyeLookOutRight", 1}}},
  };
  return kPresets;
}

/// Vowels of VRM, and the visemes that they are.
constexpr std::array<std::pair<const char*, std::string_view>, 5> kVrmVowels = {
    {{"aa", "viseme_aa"}, {"ih", "viseme_I"}, {"ou", "viseme_U"}, {"ee", "viseme_E"}, {"oh", "viseme_O"}}};

VrmPreset VowelPreset(const char* name, std::string_view viseme) {
  const auto found = std::ranges::find(rig::Visemes(), viseme, &rig::Viseme::name);
  VrmPreset preset{name, {}};
  for (const rig::VisemePart& part : found->parts) {
    // float32 0.65 is 0.65 in the file, not 0.6499999...
    preset.parts.push_back({part.expression, std::round(1000 * double(part.weight)) / 1000});
  }
  return preset;
}

void AddVrmBinds(const std::vector<int>& nodes, size_t target, double weight, Json& binds) {
  for (const int node : nodes) binds.push_back({{"node", node}, {"index", target}, {"weight", weight}});
}

/// The expression; nothing if a target is missing.
std::optional<Json> BuiltPreset(const VrmPreset& preset, const std::vector<int>& nodes,
                                const std::vector<std::string>& targets) {
  Json binds = Json::array();
  for (const PartOfPreset& part : preset.parts) {
    const bool is_pair = part.target.ends_with('*');
    const std::string stem(part.target.substr(0, part.target.size() - (is_pair ? 1 : 0)));
    for (const char* suffix : {"Left", "Right"}) {
      const auto found = std::find(targets.begin(), targets.end(), is_pair ? stem + suffix : stem);
      if (found == targets.end()) return std::nullopt;
      AddVrmBinds(nodes, size_t(found - targets.begin()), part.weight, binds);
      if (!is_pair) break;
    }
  }
  return Json{{"morphTargetBinds", binds}};
}

}  // namespace

Json VrmExpressions(const std::vector<int>& nodes, const std::vector<std::string>& targets) {
  Json expressions = {{"preset", {{"neutral", Json::object()}}}};  // Without binds: an empty list is not valid.
  const auto add = [&](const VrmPreset& preset) {
    if (auto built = BuiltPreset(preset, nodes, targets)) expressions["preset"][preset.name] = *built;
  };
  for (const VrmPreset& preset : VrmPresets()) add(preset);
  for (const auto& [name, viseme] : kVrmVowels) add(VowelPreset(name, viseme));
  for (size_t t = 0; t < targets.size(); ++t) {
    std::string name = targets[t];
    name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
    Json binds = Json::array();
    AddVrmBinds(nodes, t, 1, binds);
    expressions["custom"][name] = {{"morphTargetBinds", std::move(binds)}};
  }
  return expressions;
}

}  // namespace daumier::gltf
