#include "core/config_differences.h"

#include <fmt/format.h>

#include <set>

namespace daumier {
namespace {

void AppendDifferences(const std::string& prefix, const Json& there, const Json& now, const Json& defaults,
                       std::vector<std::string>& lines) {
  if (!there.is_object() || !now.is_object()) {
    if (there != now) lines.push_back(fmt::format("{} is {} there and {} now", prefix, there.dump(), now.dump()));
    return;
  }
  std::set<std::string> keys;
  for (const Json* side : {&there, &now})
    for (const auto& [key, value] : side->items()) keys.insert(key);
  for (const std::string& key : keys) {
    const std::string dotted = prefix.empty() ? key : fmt::format("{}.{}", prefix, key);
    const Json default_value = defaults.is_object() && defaults.contains(key) ? defaults.at(key) : Json();
    if (!now.contains(key)) {
      lines.push_back(fmt::format("{} is {} there and missing now", dotted, there[key].dump()));
    } else if (!there.contains(key) && default_value.is_null()) {
      lines.push_back(fmt::format("{} is missing there and {} now", dotted, now[key].dump()));
    } else {
      AppendDifferences(dotted, there.contains(key) ? there[key] : default_value, now[key], default_value, lines);
    }
  }
}

}  // namespace

std::vector<std::string> ConfigDifferences(const Json& there, const Json& now, const Json& defaults) {
  std::vector<std::string> lines;
  AppendDifferences("", there, now, defaults, lines);
  return lines;
}

}  // namespace daumier
