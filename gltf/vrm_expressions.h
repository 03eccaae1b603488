#pragma once
#include "core/json.h"

#include <string>
#include <vector>

namespace daumier::gltf {

/// `expressions` of VRMC_vrm 1.0 for a mesh at `node`.
/// preset: "neutral", and those of the other 17 all of whose targets are among `targets`.
/// custom: one a target, named as the target with a capital first letter. It must not have the name of a preset.
Json VrmExpressions(int node, const std::vector<std::string>& targets);

}  // namespace daumier::gltf
