#pragma once
#include "core/json.h"

#include <string>
#include <vector>

namespace daumier {

/// What differs between two configs, a line a dotted key: "optimiser.learning_rate is 0.001 there and 0.01 now". A key
/// that is missing there counts as its value in `defaults`.
std::vector<std::string> ConfigDifferences(const Json& there, const Json& now, const Json& defaults = Json::object());

}  // namespace daumier
