#pragma once
#include "core/json.h"
#include "faces/head_material.h"

#include <optional>
#include <vector>

/// What triangles of a head show, as runs in `extras.triangles` of a node: a textured head states it nowhere else.
namespace daumier::gltf {

/// {"materials": [["skin", 20000], ["lid_rim", 300], ...], "neckCap": [[first, count], ...]}; without "neckCap" if there
/// is none. `neck_cap`: triangles, ascending.
Json TriangleRuns(const std::vector<faces::HeadMaterial>& materials, const std::vector<int>& neck_cap);

struct ReadTriangleRuns {
  std::vector<faces::HeadMaterial> materials;
  std::vector<int> neck_cap;
};
/// Undoes TriangleRuns; nothing if the text is no runs of `num_triangles` triangles.
std::optional<ReadTriangleRuns> ParseTriangleRuns(const Json& runs, int64_t num_triangles);

}  // namespace daumier::gltf
