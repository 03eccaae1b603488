#pragma once
#include "core/random.h"
#include "geometry/mesh.h"

#include <vector>

namespace daumier::geometry {

/// Points on a surface: point s is w0 p0 + w1 p1 + (1 - w0 - w1) p2 with p0, p1, p2 the corners of triangles[s].
struct SurfaceSamples {
  std::vector<int> triangles;  ///< S
  std::vector<float> weights;  ///< S x 2: w0 and w1 of each point, at least 0 and together at most 1.
};

/// Draws `count` independent points, uniform by area [Osada et al. 2002, section 4.2]; triangles without area get none.
/// @throws Error if the surface has no area.
SurfaceSamples SampleSurface(const TriangleMesh& mesh, int count, Rng& rng);

}  // namespace daumier::geometry
