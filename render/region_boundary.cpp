#include "render/region_boundary.h"

#include "core/error.h"

#include <algorithm>
#include <array>

namespace daumier::render {
namespace {

/// Pieces within the square of four centres; corners and edges go around it from the upper left corner and the upper edge.
void AddPieces(const std::array<double, 4>& values, const std::array<Eigen::Vector2d, 4>& corners,
               std::vector<BoundaryPiece>& pieces) {
  std::array<Eigen::Vector2d, 4> crossings;
  std::array<int, 4> crossed = {};
  int num_crossed = 0;
  for (int edge = 0; edge < 4; ++edge) {
    const double a = values[size_t(edge)], b = values[size_t((edge + 1) % 4)];
    if ((a > 0) == (b > 0)) continue;
    crossings[size_t(edge)] =
        corners[size_t(edge)] + (corners[size_t((edge + 1) % 4)] - corners[size_t(edge)]) * (a / (a - b));
    crossed[size_t(num_crossed++)] = edge;
  }
  const auto add = [&](int a, int b) { pieces.push_back({crossings[size_t(a)], crossings[size_t(b)]}); };
  if (num_crossed == 2) add(crossed[0], crossed[1]);
  if (num_crossed < 4) return;
  if (values[0] > 0) {  // Around the corners 0 and 2.
    add(3, 0), add(1, 2);
  } else {
    add(0, 1), add(2, 3);
  }
}

}  // namespace

std::vector<BoundaryPiece> ZeroBoundary(std::span<const float> field, int height, int width) {
  DAUMIER_CHECK(field.size() == size_t(height) * size_t(width), "a field of {} numbers is no {} x {}", field.size(),
                height, width);
  std::vector<BoundaryPiece> pieces;
  const auto value = [&](int row, int column) { return double(field[size_t(row) * size_t(width) + size_t(column)]); };
  for (int row = 0; row + 1 < height; ++row)
    for (int column = 0; column + 1 < width; ++column) {
      const double x = column + 0.5, y = row + 0.5;
      AddPieces({value(row, column), value(row, column + 1), value(row + 1, column + 1), value(row + 1, column)},
                {Eigen::Vector2d(x, y), {x + 1, y}, {x + 1, y + 1}, {x, y + 1}}, pieces);
    }
  return pieces;
}

std::optional<Eigen::Vector2d> NearestOnBoundary(std::span<const BoundaryPiece> pieces, const Eigen::Vector2d& point,
                                                 double reach) {
  std::optional<Eigen::Vector2d> nearest;
  double least = reach * reach;
  for (const BoundaryPiece& piece : pieces) {
    const Eigen::Vector2d along = piece.to - piece.from;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0 ? std::clamp((point - piece.from).dot(along) / length2, 0.0, 1.0) : 0.0;
    const Eigen::Vector2d candidate = piece.from + t * along;
    const double distance2 = (candidate - point).squaredNorm();
    if (distance2 < least || (!nearest && distance2 == least)) {
      least = distance2;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace daumier::render
