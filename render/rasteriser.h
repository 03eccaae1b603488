#pragma once
#include "geometry/mesh.h"
#include "render/camera.h"

#include <array>
#include <cstddef>
#include <vector>

namespace daumier::render {

/// The surface at each pixel's centre, row-major, height * width entries.
struct Raster {
  int height = 0, width = 0;
  std::vector<int> triangle = {};  ///< Row of the triangle in front, -1 where there is none.
  std::vector<std::array<float, 3>> barycentric =
      {};                          ///< Of the point on the surface, in the order of the triangle's corners; sum 1.
  std::vector<double> depth = {};  ///< Of the point, cm; infinite where there is none.

  size_t index(int row, int column) const { return size_t(row) * width + column; }
};

struct RasterOptions {
  bool cull_back_faces = false;  ///< Leave out triangles that are seen from inside.
};

/// Z-buffered triangles. Vertices are rounded to 1/1024 pixel, which makes the edge functions exact in double precision
/// for vertices within 2^15 pixels of the origin: a pixel centre on an edge that two triangles share belongs to one of
/// them (the one for which it is a top or a left edge), so that a surface is covered without cracks and without
/// overlaps. At equal depth the lower row wins. Barycentrics are those of the point on the surface in perspective too.
/// Triangles that reach nearer than 1/1000 cm to a perspective viewer are left out, as are those that are seen edge-on.
/// @throws Error if the camera has no pixels, a triangle names a vertex that is not there, or a projected coordinate is
/// not finite or farther than 2^30 pixels away.
Raster Rasterise(const Camera& camera, const geometry::TriangleMesh& mesh, const RasterOptions& options = {});

}  // namespace daumier::render
