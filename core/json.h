#pragma once
#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace daumier {

/// Keeps the order in which keys were set, so that files read as they were written and equal content has equal bytes.
using Json = nlohmann::ordered_json;

/// Values may be nested 200 deep. @throws Error "NAME: not JSON: ..." with line and column, of a text of one line with
/// the column alone.
Json ParseJson(std::string_view text, const std::string& name);

/// @throws Error as ReadFile and ParseJson.
Json ReadJson(const std::filesystem::path& file);

/// Empty if the text is not JSON, as ParseJson.
std::optional<Json> TryParseJson(std::string_view text);

/// What is wrong, without the library's own codes.
std::string TextOf(const Json::exception& error);

}  // namespace daumier
