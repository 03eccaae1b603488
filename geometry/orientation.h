#pragma once
#include "geometry/mesh.h"

#include <Eigen/Core>

namespace daumier::geometry {

/// How far a surface is wound outwards, in [-1, 1]: sum_f A_f n_f . (x_f - c) / sum_f A_f |x_f - c|, over its triangles
/// with area A, normal n and middle x, c the middle of its area. 1 for a sphere, -1 for one inside out; of open and
/// creased surfaces between them; 0 without area.
double Outwardness(const TriangleMesh& mesh);

struct OrientedSurface {
  Triangles triangles;
  int num_turned = 0;  ///< Triangles with another winding than before.
};

/// Winds the triangles of a surface alike and outwards. Patches of triangles that are wound alike across edges of two
/// triangles are joined to pieces where the surface bends by less than 90 degrees from one to the other, along nine
/// tenths of their common edges and a quarter of the border of one; sheets that touch are not. Of a piece the smaller
/// part of the area is turned to match the larger one. Then a closed piece is turned if its Outwardness is below -0.05,
/// and all open ones together by theirs. One-sided pieces stay as they are.
OrientedSurface OrientOutwards(const TriangleMesh& mesh);

}  // namespace daumier::geometry
