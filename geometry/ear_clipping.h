#pragma once
#include "geometry/mesh.h"

namespace daumier::geometry {

/// N x 2, in order around.
using FlatPolygon = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// Positive for a polygon that runs counter-clockwise.
double SignedArea(const FlatPolygon& polygon);

/// Whether no two sides that do not follow each other have a point in common. O(N^2).
bool IsSimple(const FlatPolygon& polygon);

/// A simple polygon that runs counter-clockwise as N - 2 triangles of its corners, by ears [Meisters 1975]: of the ears that
/// there are, the one whose least angle is largest is cut first. O(N^2) for few reflex corners.
/// @throws Error on fewer than three corners, or where no ear is left, as on polygons that cross themselves.
Triangles ClipEars(const FlatPolygon& polygon);

}  // namespace daumier::geometry
