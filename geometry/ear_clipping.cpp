#include "geometry/ear_clipping.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace daumier::geometry {
namespace {

using PolygonCorner = Eigen::RowVector2d;

/// Twice the area of a triangle, positive if it runs counter-clockwise.
double TurnOf(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool Touch(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c, const PolygonCorner& d) {
  const auto lies_on = [](const PolygonCorner& p, const PolygonCorner& q, const PolygonCorner& point) {
    return TurnOf(p, q, point) == 0 && (point - p).dot(point - q) <= 0;
  };
  if (lies_on(a, b, c) || lies_on(a, b, d) || lies_on(c, d, a) || lies_on(c, d, b)) return true;
  return TurnOf(a, b, c) * TurnOf(a, b, d) < 0 && TurnOf(c, d, a) * TurnOf(c, d, b) < 0;
}

/// Twice the area by the square of the longest side: 0 for a triangle without area.
double Fatness(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  return TurnOf(a, b, c) / std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
}

}  // namespace

double SignedArea(const FlatPolygon& polygon) {
  double sum = 0;
  for (Eigen::Index i = 0; i < polygon.rows(); ++i)
    sum += TurnOf(polygon.row(0), polygon.row(i), polygon.row((i + 1) % polygon.rows()));
  return 0.5 * sum;
}

bool IsSimple(const FlatPolygon& polygon) {
  const Eigen::Index n = polygon.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && Touch(polygon.row(i), polygon.row(i + 1), polygon.row(j), polygon.row((j + 1) % n)))
        return false;
  return n >= 3;
}

Triangles ClipEars(const FlatPolygon& polygon) {
  const int n = int(polygon.rows());
  DAUMIER_CHECK(n >= 3, "a polygon has {} corners, expected 3 or more", n);
  std::vector<int> rest(size_t(n), 0);
  std::iota(rest.begin(), rest.end(), 0);
  Triangles triangles(n - 2, 3);
  const auto fatness = [&](size_t i) {
    const size_t size = rest.size();
    const int a = rest[(i + size - 1) % size], b = rest[i], c = rest[(i + 1) % size];
    const double fat = Fatness(polygon.row(a), polygon.row(b), polygon.row(c));
    if (fat <= 0) return fat;
    const bool has_corner = std::ranges::any_of(rest, [&](int p) {
      return p != a && p != b && p != c && TurnOf(polygon.row(a), polygon.row(b), polygon.row(p)) >= 0 &&
             TurnOf(polygon.row(b), polygon.row(c), polygon.row(p)) >= 0 &&
             TurnOf(polygon.row(c), polygon.row(a), polygon.row(p)) >= 0;
    });
    return has_corner ? -1.0 : fat;
  };
  std::vector<double> ears(size_t(n), 0.0);
  for (size_t i = 0; i < rest.size(); ++i) ears[i] = fatness(i);
  for (int f = 0; f < n - 3; ++f) {
    const auto best = std::ranges::max_element(ears);
    DAUMIER_CHECK(*best >= 0, "a polygon of {} corners crosses itself", n);
    const size_t i = size_t(best - ears.begin()), size = rest.size();
    triangles.row(f) << rest[(i + size - 1) % size], rest[i], rest[(i + 1) % size];
    rest.erase(rest.begin() + std::ptrdiff_t(i));
    ears.erase(best);
    for (const size_t near : {(i + size - 2) % (size - 1), i % (size - 1)}) ears[near] = fatness(near);
  }
  triangles.row(n - 3) << rest[0], rest[1], rest[2];
  return triangles;
}

}  // namespace daumier::geometry
