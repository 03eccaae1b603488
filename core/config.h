#pragma once
#include "core/json.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier {

/// Reads a TOML file; `parent = "other.toml"` (relative to the file) is read first and overridden key by key.
/// `overrides` are `key=value` or `table.key=value`, values in TOML syntax; a bare word is taken as text.
/// The `parent` key itself is not in the result. An empty `path` starts from nothing.
/// @throws UsageError naming the file, line and cause: missing file, syntax error, cyclic parents, bad override.
Json LoadConfig(const std::filesystem::path& path, const std::vector<std::string>& overrides = {});

/// TOML text of a config, a line a value under its dotted key; LoadConfig of it gives the same JSON in the same order.
/// @throws Error on what TOML cannot say: null, integers above 2^63 - 1.
std::string ToToml(const Json& config);

}  // namespace daumier
