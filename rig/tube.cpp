#include "rig/tube.h"

#include "core/error.h"

namespace daumier::rig {

std::vector<int> Tube::Sides() const {
  std::vector<int> sides;
  for (int column = 0; column + 1 < num_columns; ++column)
    for (int side = 0; side < num_sides; ++side) sides.insert(sides.end(), 2, side);
  for (int pole = 0; pole < 2; ++pole)
    for (int side = 0; side < num_sides; ++side) sides.push_back(side);
  return sides;
}

ChartPiece TubeChart(const Tube& tube, const std::vector<double>& columns, double height, TextureChart chart,
                     int first_vertex, double size) {
  DAUMIER_CHECK(int(columns.size()) == tube.num_columns, "{} places were given for {} columns of a tube",
                columns.size(), tube.num_columns);
  constexpr double kTooth = 0.04;  // Length of the poles' triangles.
  ChartPiece piece{
      chart, geometry::Triangles(tube.num_triangles(), 3), {}, geometry::Triangles(tube.num_triangles(), 3), size};
  const int num_sides = tube.num_sides, first_pole = tube.num_columns * (num_sides + 1);
  piece.uv.resize(first_pole + 2 * num_sides, 2);
  const auto v_of = [&](double side) { return height * side / num_sides; };
  for (int column = 0; column < tube.num_columns; ++column)
    for (int side = 0; side <= num_sides; ++side)
      piece.uv.row(column * (num_sides + 1) + side) << columns[size_t(column)], v_of(side);
  for (int side = 0; side < num_sides; ++side) {
    piece.uv.row(first_pole + side) << columns.front() - kTooth, v_of(side + 0.5);
    piece.uv.row(first_pole + num_sides + side) << columns.back() + kTooth, v_of(side + 0.5);
  }
  Eigen::Index row = 0;
  const auto add = [&](Eigen::RowVector3i triangle, const Eigen::RowVector3i& of_uv) {
    piece.triangles.row(row) = triangle.array() + first_vertex;
    piece.uv_triangles.row(row++) = of_uv;
  };
  const auto at = [&](int column, int side) { return column * (num_sides + 1) + side; };
  for (int column = 0; column + 1 < tube.num_columns; ++column) {
    for (int side = 0; side < num_sides; ++side) {
      const int a = tube.vertex(column, side), b = tube.vertex(column + 1, side), c = tube.vertex(column + 1, side + 1),
                d = tube.vertex(column, side + 1);
      add({a, b, c}, {at(column, side), at(column + 1, side), at(column + 1, side + 1)});
      add({a, c, d}, {at(column, side), at(column + 1, side + 1), at(column, side + 1)});
    }
  }
  const int last = tube.num_columns - 1;
  for (int side = 0; side < num_sides; ++side)
    add({tube.vertex(0, side), tube.vertex(0, side + 1), tube.pole(false)},
        {at(0, side), at(0, side + 1), first_pole + side});
  for (int side = 0; side < num_sides; ++side)
    add({tube.vertex(last, side + 1), tube.vertex(last, side), tube.pole(true)},
        {at(last, side + 1), at(last, side), first_pole + num_sides + side});
  return piece;
}

}  // namespace daumier::rig
