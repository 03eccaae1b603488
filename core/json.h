#pragma once
#include <nlohmann/json.hpp>

namespace daumier {

/// Keeps the order in which keys were set, so that files read as they were written and equal content has equal bytes.
using Json = nlohmann::ordered_json;

}  // namespace daumier
