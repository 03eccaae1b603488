#pragma once
#include "rig/expression_map.h"

#include <string>

namespace daumier::rig {

inline constexpr const char* kExpressionMapKind = "expression_map";
inline constexpr int kExpressionMapVersion = 1;

/// The map as JSON (docs/formats.md): numbers to six decimals, errors in mm.
Json ExpressionMapJson(const ExpressionMap& map);

/// `name`: what messages call the file.
/// @throws Error naming the file and the cause: another kind or version, a missing entry, names of targets that are not
/// those of ArkitNames(), rows of another length, or a number that is negative or not
/// finite.
ExpressionMap ParseExpressionMap(const Json& json, const std::string& name);

}  // namespace daumier::rig
