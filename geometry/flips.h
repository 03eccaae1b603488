#pragma once
#include "geometry/mesh.h"
#include "geometry/topology.h"

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

/// `after` without FlippedTriangles in `subset`: around them its displacement from `before` is averaged over neighbours,
/// again and again over ever more rings, at most twelve times. Returns `after` where nothing flips. A displacement that is
/// constant around a triangle only moves it, so that flips in small spots end. @throws Error if a shape disagrees.
Points RelaxFlips(const Points& before, const Points& after, const Triangles& triangles, const Adjacency& neighbours,
                  const std::vector<int>& subset = {});

}  // namespace daumier::geometry
