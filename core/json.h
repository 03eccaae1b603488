#pragma once
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace daumier {

/// Keeps the order in which keys were set, so that files read as they were written and equal content has equal bytes.
using Json = nlohmann::ordered_json;

/// @throws Error "NAME: not JSON: ..." with line and column.
Json ParseJson(std::string_view text, const std::string& name);

/// @throws Error as ReadFile and ParseJson.
Json ReadJson(const std::filesystem::path& file);

/// Empty if the text is not JSON.
std::optional<Json> TryParseJson(std::string_view text);

}  // namespace daumier
