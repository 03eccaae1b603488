#include "geometry/flips.h"

#include "core/error.h"
#include "geometry/normals.h"

#include <algorithm>

namespace daumier::geometry {

std::vector<int> FlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                                  const std::vector<int>& subset) {
  DAUMIER_CHECK(before.rows() == after.rows(), "{} vertices before, {} after", before.rows(), after.rows());
  const Points normals_before = AreaNormals({before, triangles}), normals_after = AreaNormals({after, triangles});
  const auto is_inside = [&](int v) { return subset.empty() || std::binary_search(subset.begin(), subset.end(), v); };
  std::vector<int> flipped;
  for (int f = 0; f < triangles.rows(); ++f) {
    if (!is_inside(triangles(f, 0)) || !is_inside(triangles(f, 1)) || !is_inside(triangles(f, 2))) continue;
    if (!(normals_before.row(f).dot(normals_after.row(f)) > 0) && normals_before.row(f).squaredNorm() > 0)
      flipped.push_back(f);
  }
  return flipped;
}

Points RelaxFlips(const Points& before, const Points& after, const Triangles& triangles, const Adjacency& neighbours,
                  const std::vector<int>& subset) {
  constexpr int kMaxRounds = 12, kRoundsARing = 3;
  Points relaxed = after;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<int> corners;
    for (const int f : FlippedTriangles(before, relaxed, triangles, subset))
      corners.insert(corners.end(), {triangles(f, 0), triangles(f, 1), triangles(f, 2)});
    if (corners.empty()) break;
    const Points displacement = relaxed - before;
    for (const int v : VerticesWithin(neighbours, corners, round / kRoundsARing)) {
      Eigen::RowVector3d sum = displacement.row(v);
      for (const int other : neighbours[v]) sum += displacement.row(other);
      relaxed.row(v) = before.row(v) + sum / double(neighbours[v].size() + 1);
    }
  }
  return relaxed;
}

int CountFlippedTriangles(const Points& before, const Points& after, const Triangles& triangles,
                          const std::vector<int>& subset) {
  return static_cast<int>(FlippedTriangles(before, after, triangles, subset).size());
}

}  // namespace daumier::geometry
