#include "cli/avatar_keys.h"

#include "core/error.h"

#include <algorithm>
#include <string_view>

namespace daumier::cli {
namespace {

/// Calls `check` with each key as it is given: "avatar.texture.size".
template <class Check>
void ForEachKey(const Json& config, Check check) {
  const Json flat = config.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    if (pointer.empty()) continue;  // An empty config.
    std::string key = pointer.substr(1);
    std::ranges::replace(key, '/', '.');
    check(key);
  }
}

}  // namespace

void CheckStyleKeys(const Json& config, const std::string& style) {
  ForEachKey(config, [&](const std::string& key) {
    if (key.starts_with("avatar.toon.") && style != "toon")
      throw UsageError(fmt::format("{}: has no effect. Add --style toon, or leave it out", key));
    if (key.starts_with("avatar.network.") && (style == "none" || style == "toon"))
      throw UsageError(fmt::format("{}: has no effect. Add --style FILE.onnx, or leave it out", key));
    if (key != "avatar.texture.light_share" && key != "avatar.texture.fit_light") return;
    if (config.value(Json::json_pointer("/avatar/texture/delight"), Json(true)) == Json(false))
      throw UsageError(fmt::format("{}: has no effect with avatar.texture.delight=false. Leave one of them out", key));
  });
}

void CheckPortraitKeys(const Json& config, const std::string& picture) {
  ForEachKey(config, [&](const std::string& key) {
    if (key.starts_with("palette."))
      throw UsageError(
          fmt::format("{}: colours the head of a drawing, and {} is read as a portrait, whose head is painted from it. "
                      "Leave it out, or add --as drawing",
                      key, picture));
  });
}

void CheckDrawingKeys(const Json& config, const std::string& picture) {
  ForEachKey(config, [&](const std::string& key) {
    if (key == "avatar.texture.size" || key.starts_with("palette.")) return;
    throw UsageError(fmt::format("{}: is of portraits, and {} is read as a drawing. Leave it out, or add --as portrait",
                                 key, picture));
  });
}

}  // namespace daumier::cli
