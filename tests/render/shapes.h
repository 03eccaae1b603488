#pragma once
#include "geometry/mesh.h"

#include <cmath>
#include <numbers>

namespace daumier::testing {

/// A unit sphere about the origin whose poles are on the y axis, `columns` quads around, half as many from pole to
/// pole; wound outward.
inline geometry::TriangleMesh Globe(int columns) {
  const int rows = columns / 2;
  geometry::TriangleMesh mesh;
  mesh.vertices.resize(columns * (rows + 1), 3);
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const double a = 2 * std::numbers::pi * i / columns, b = std::numbers::pi * (static_cast<double>(j) / rows - 0.5);
      mesh.vertices.row(j * columns + i) << std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b);
    }
  }
  mesh.triangles.resize(2 * columns * rows, 3);
  int next = 0;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const int v = j * columns + i, right = j * columns + (i + 1) % columns;
      mesh.triangles.row(next++) << v, right, right + columns;
      mesh.triangles.row(next++) << v, right + columns, v + columns;
    }
  }
  return mesh;
}

/// The square [-1, 1] x [-1, 1] at z = 0, facing +z.
inline geometry::TriangleMesh Square() {
  geometry::TriangleMesh mesh{geometry::Points(4, 3), geometry::Triangles(2, 3)};
  mesh.vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

}  // namespace daumier::testing
