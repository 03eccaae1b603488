#include "rig/target_names.h"

#include "rig/arkit_names.h"
#include "rig/gaze.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace daumier::rig {
namespace {

/// Indices of ARKit names in the order of a preset.
std::vector<int> OrderOf(NamePreset preset) {
  std::vector<int> order(kNumArkitNames);
  std::iota(order.begin(), order.end(), 0);
  if (preset != NamePreset::kMediaPipe) return order;
  order.assign(MediaPipeOrder().begin(), MediaPipeOrder().end());
  order.push_back(FindArkitName("tongueOut").value());
  return order;
}

ArkitSpelling SpellingOf(NamePreset preset) {
  if (preset == NamePreset::kArkitSides) return ArkitSpelling::kSides;
  return preset == NamePreset::kUnreal ? ArkitSpelling::kPascalCase : ArkitSpelling::kCamelCase;
}

std::string NameIn(const std::string& name, NamePreset preset) {
  const auto index = FindArkitName(name);
  return index ? SpellArkitName(*index, SpellingOf(preset)) : name;
}

}  // namespace

MorphTargets InPreset(const MorphTargets& targets, NamePreset preset) {
  std::vector<int> columns(kNumArkitNames, -1), others;
  for (int t = 0; t < targets.num_targets(); ++t) {
    const auto index = FindArkitName(targets.names[size_t(t)]);
    if (index) columns[size_t(*index)] = t;
    if (!index) others.push_back(t);
  }
  std::vector<int> sources;
  if (preset == NamePreset::kMediaPipe) sources.push_back(-1);
  if (preset == NamePreset::kReadyPlayerMe) {  // Its readers take the target of index 0 for none.
    const auto rest = std::stable_partition(others.begin(), others.end(),
                                            [&](int t) { return targets.names[size_t(t)].starts_with("viseme_"); });
    sources.assign(others.begin(), rest);
    others.erase(others.begin(), rest);
  }
  for (const int index : OrderOf(preset))
    if (columns[size_t(index)] >= 0) sources.push_back(columns[size_t(index)]);
  sources.insert(sources.end(), others.begin(), others.end());

  MorphTargets result{{}, Eigen::MatrixXf::Zero(targets.offsets.rows(), Eigen::Index(sources.size()))};
  for (size_t t = 0; t < sources.size(); ++t) {
    const int source = sources[t];
    result.names.push_back(source < 0 ? "_neutral" : NameIn(targets.names[size_t(source)], preset));
    if (source >= 0) result.offsets.col(Eigen::Index(t)) = targets.offsets.col(source);
  }
  return result;
}

WeightsClip InPreset(const WeightsClip& clip, NamePreset preset) {
  WeightsClip result = clip;
  result.right_eye = EyeTurns(clip, EyeSide::kRight);
  result.left_eye = EyeTurns(clip, EyeSide::kLeft);
  for (std::string& name : result.names) name = NameIn(name, preset);
  return result;
}

}  // namespace daumier::rig
