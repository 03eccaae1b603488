#pragma once
#include "core/json.h"

#include <string>
#include <vector>

namespace daumier::gltf {

/// `expressions` of VRMC_vrm 1.0 for meshes at `nodes`, which have the same targets.
/// preset: "neutral", and those of the other 17 all of whose targets are among `targets`.
/// custom: one a target, named as the target with a capital first letter. It must not have the name of a preset.
Json VrmExpressions(const std::vector<int>& nodes, const std::vector<std::string>& targets);

}  // namespace daumier::gltf
