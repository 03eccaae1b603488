#include "systems/prediction_options.h"

#include <algorithm>

namespace daumier::systems {

bool HasPredictionOption(const System& system, std::string_view key) {
  if (system.resolve_prediction == nullptr) return false;
  const Json options = system.resolve_prediction(Json::object(), "predict");
  const Json* at = &options;
  while (true) {
    const size_t dot = key.find('.');
    if (!at->is_object()) return false;
    const auto found = at->find(std::string(key.substr(0, dot)));
    if (found == at->end()) return false;
    if (dot == std::string_view::npos) return true;
    at = &*found;
    key.remove_prefix(dot + 1);
  }
}

std::vector<std::string> OverridesOf(const System& system, std::span<const System* const> tasks,
                                     const std::vector<std::string>& overrides) {
  std::vector<std::string> own;
  for (const std::string& word : overrides) {
    const std::string_view key = std::string_view(word).substr(0, word.find('='));
    const auto has = [&](const System* task) { return HasPredictionOption(*task, key); };
    if (has(&system) || std::ranges::none_of(tasks, has)) own.push_back(word);
  }
  return own;
}

}  // namespace daumier::systems
