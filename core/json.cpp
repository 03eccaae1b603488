#include "core/json.h"

#include "core/error.h"
#include "core/files.h"

namespace daumier {

Json ParseJson(std::string_view text, const std::string& name) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: not JSON: {}", name, error.what()));
  }
}

Json ReadJson(const std::filesystem::path& file) {
  return ParseJson(ReadFile(file), file.string());
}

std::optional<Json> TryParseJson(std::string_view text) {
  Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  return json.is_discarded() ? std::nullopt : std::optional<Json>(std::move(json));
}

}  // namespace daumier
