#pragma once
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// The triangles with all corners in `subset` (sorted vertices; empty: all triangles) whose normal turned by more than
/// 90 degrees from `before` to `after` or that lost their area, ascending. Both are V x 3. @throws Error if a shape
/// disagrees.
std::vector<int> FlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                                  const std::vector<int>& subset = {});

/// How many they are.
int CountFlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                          const std::vector<int>& subset = {});

}  // namespace daumier::geometry
