#pragma once
#include <string>
#include <string_view>

namespace daumier {

/// What of a TOML text is nested deeper than any config: a key or a table's name of more than 100 dots, or lists and
/// inline tables of more than 32 levels. The parser recurses with both and does not bound the first. Such as
/// "line 3: a key has more than 100 dots"; empty if all is well. The text need not be valid TOML.
std::string TooDeepInToml(std::string_view text);

}  // namespace daumier
