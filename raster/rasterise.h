#pragma once
#include "raster/visibility.h"

namespace daumier::raster {

/// Z-buffered triangles. positions: V x 4, homogeneous pixel coordinates (X, Y, Z, w) of raster/camera.h. With
/// p_i = (X_i, Y_i) - f w_i for a pixel centre f, a0 = p1 x p2, a1 = p2 x p0, a2 = p0 x p1: b_i = a_i / (a0 + a1 + a2)
/// [Laine et al. 2020, section 3.2], so that barycentrics are those of the point on the surface in perspective too.
/// A closed fan of triangles covers each pixel once: signs of edge functions are exact for the vertices' distances from
/// the pixel centre, rounded to T. A centre on an edge belongs to the triangle for which the edge is top or left. At
/// equal depth the lower row wins. Triangles with a vertex of w < kNearestW are left out, as are those seen edge-on.
/// @throws Error if a side of the picture is below 1 or above kMaxPictureSide, or a number is not finite.
template <class T>
void Rasterise(const MeshTopology& topology, const T* positions, int height, int width, Facing facing,
               Raster<T>& raster);

/// Adds to position_gradient (V x 4) the gradient of sum(barycentric * barycentric_gradient); barycentric_gradient:
/// H x W x 2, not read where there is no triangle. The third column of position_gradient is unchanged: depth carries no
/// gradient. With c the function of which the gradient by b is given: dL/d(X_j, Y_j) = -b_j / w(f) dc/df and
/// dL/dw_j = -f . dL/d(X_j, Y_j), w(f) being that of the point on the surface.
template <class T>
void RasteriseBackward(const MeshTopology& topology, const Raster<T>& raster, const T* barycentric_gradient,
                       T* position_gradient);

}  // namespace daumier::raster
