#pragma once
#include "rig/head_charts.h"

#include <vector>

namespace daumier::rig {

/// The topology of a closed surface: `num_columns` loops of `num_sides` vertices one after the other, and a pole at each
/// end. Vertices: column by column, then the pole before the first column and that behind the last.
struct Tube {
  int num_columns, num_sides;

  int num_vertices() const { return num_columns * num_sides + 2; }
  int vertex(int column, int side) const { return column * num_sides + side % num_sides; }
  int pole(bool last) const { return num_columns * num_sides + (last ? 1 : 0); }
  /// 2 num_columns num_sides: between columns side by side, 2 triangles each, then the fan of each pole. Outwards where
  /// sides run clockwise around the direction of the columns.
  int num_triangles() const { return 2 * num_columns * num_sides; }
  /// The side, from 0, of each triangle: that between the vertices `side` and side + 1.
  std::vector<int> Sides() const;
};

/// A tube slit along side 0 as a strip, columns from the left to the right at their share of the length, with a saw-tooth
/// at each pole. `columns`: the place of each column in 0 .. 1, ascending; `height`: of the strip in parts of its length.
ChartPiece TubeChart(const Tube& tube, const std::vector<double>& columns, double height, TextureChart chart,
                     int first_vertex, double size);

}  // namespace daumier::rig
