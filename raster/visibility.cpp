#include "raster/visibility.h"

#include "core/error.h"
#include "raster/lanes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace daumier::raster {
namespace {

static_assert(sizeof(ScreenVertex<float>) == 16 && sizeof(ScreenVertex<double>) == 32);

template <class T>
void ToScreen(const T* positions, int num_vertices, std::vector<ScreenVertex<T>>& vertices) {
  vertices.resize(num_vertices);
  Lanes<T> differences = {};  // x - x is 0 for finite numbers alone.
  for (int v = 0; v < num_vertices; ++v) {
    Lanes<T> position;
    LoadLanes(positions + 4 * int64_t(v), position);
    differences += position - position;
    const T inverse_w = 1 / position[3];
    Lanes<T> screen = position * inverse_w;
    screen[3] = inverse_w;
    if (!(position[3] >= T(kNearestW))) screen[0] = std::numeric_limits<T>::quiet_NaN();
    StoreLanes(&vertices[v].x, screen);
  }
  for (int k = 0; k < 4; ++k) {
    DAUMIER_CHECK(differences[k] == 0, "positions have a number that is not finite in column {}", k);
  }
}

/// The sign of ax by - bx ay, exactly; `rounded` is that number in T, whose sign is right unless it is 0.
template <class T>
T ExactCross(T ax, T ay, T bx, T by, T rounded) {
  if (rounded != 0) return rounded;
  if constexpr (sizeof(T) == sizeof(float)) {
    return static_cast<T>(std::copysign(1.0, double(ax) * by - double(bx) * ay) * (double(ax) * by != double(bx) * ay));
  } else {
    const T plus = ax * by, minus = bx * ay;
    return std::fma(ax, by, -plus) - std::fma(bx, ay, -minus);
  }
}

/// A triangle whose corners run clockwise in the picture (y down), so that edge functions are positive inside.
template <class T>
class TrianglePainter {
 public:
  TrianglePainter(const ScreenVertex<T>& p0, const ScreenVertex<T>& p1, const ScreenVertex<T>& p2, int row,
                  Raster<T>& raster)
      : p_{&p0, &p1, &p2}, triangle_(row), raster_(raster) {}

  /// Pixels of a rectangle, bounds included.
  void Paint(int left, int right, int top, int bottom) const {
    const int width = raster_.width;
    for (int row = top; row <= bottom; ++row) {
      if (width < 4) {
        for (int column = left; column <= right; ++column) PaintPixel(row, column);
      } else {
        for (int column = left; column <= right; column += 4) PaintFour(row, std::min(column, width - 4));
      }
    }
  }

 private:
  __attribute__((always_inline)) void PaintFour(int row, int column) const {
    const T fy = T(row) + T(0.5), fx = T(column) + T(0.5);
    const Lanes<T> centres = {fx, fx + 1, fx + 2, fx + 3};
    const Lanes<T> x0 = p_[0]->x - centres, x1 = p_[1]->x - centres, x2 = p_[2]->x - centres;
    const T y0 = p_[0]->y - fy, y1 = p_[1]->y - fy, y2 = p_[2]->y - fy;
    const Lanes<T> e0 = x1 * y2 - x2 * y1, e1 = x2 * y0 - x0 * y2, e2 = x0 * y1 - x1 * y0;
    const auto touched = (e0 >= 0) & (e1 >= 0) & (e2 >= 0);
    if (!AnyLane(touched)) return;
    const auto inside = (e0 > 0) & (e1 > 0) & (e2 > 0);
    if (AnyLane(touched ^ inside)) {  // A centre on an edge, as far as T can resolve.
      for (int k = 0; k < 4; ++k) {
        if (touched[k]) PaintPixel(row, column + k);
      }
      return;
    }
    const int64_t first = int64_t(row) * raster_.width + column;
    const Lanes<T> depth = (e0 * p_[0]->depth + e1 * p_[1]->depth + e2 * p_[2]->depth) / (e0 + e1 + e2);
    Lanes<T> old_depth;
    LoadLanes(&raster_.depth[first], old_depth);
    const auto is_nearer = inside & (depth < old_depth);
    StoreLanes<T>(&raster_.depth[first], is_nearer ? depth : old_depth);
    if constexpr (sizeof(T) == sizeof(int)) {
      Lanes<int> old_triangle;
      LoadLanes(&raster_.triangle[first], old_triangle);
      const Lanes<int> triangle = {triangle_, triangle_, triangle_, triangle_};
      StoreLanes<int>(&raster_.triangle[first], is_nearer ? triangle : old_triangle);
    } else {
      for (int k = 0; k < 4; ++k) {
        if (is_nearer[k]) raster_.triangle[first + k] = triangle_;
      }
    }
  }

  void PaintPixel(int row, int column) const {
    const T fx = T(column) + T(0.5), fy = T(row) + T(0.5);
    T e[3], total = 0, weighted = 0;
    for (int k = 0; k < 3; ++k) {
      const ScreenVertex<T>&a = *p_[(k + 1) % 3], &b = *p_[(k + 2) % 3];
      const T ax = a.x - fx, ay = a.y - fy, bx = b.x - fx, by = b.y - fy;
      e[k] = ax * by - bx * ay;
      const T sign = ExactCross(ax, ay, bx, by, e[k]);
      const bool is_top_or_left = b.y < a.y || (b.y == a.y && b.x > a.x);
      if (sign < 0 || (sign == 0 && !is_top_or_left)) return;
      total += e[k];
      weighted += e[k] * p_[k]->depth;
    }
    const int64_t pixel = int64_t(row) * raster_.width + column;
    const T depth = weighted / total;
    if (!(depth < raster_.depth[pixel])) return;  // Also if all edge functions are 0.
    raster_.depth[pixel] = depth;
    raster_.triangle[pixel] = triangle_;
  }

  const ScreenVertex<T>* p_[3];
  const int triangle_;
  Raster<T>& raster_;
};

/// Finds facing and bounds of all triangles, without branches: about half of them are drawn, in no pattern that a
/// processor could foresee.
template <class T>
void BoundTriangles(const MeshTopology& topology, Facing facing, Raster<T>& raster) {
  typedef int Bounds __attribute__((vector_size(4 * sizeof(int))));
  const ScreenVertex<T>* const vertices = raster.vertices.data();
  const T width = T(raster.width), height = T(raster.height);
  const Lanes<T> largest = {width, height, width, height}, none = {}, half = {T(0.5), T(0.5), T(0.5), T(0.5)};
  const int least_side = facing == Facing::kFront ? 1 : -1;
  raster.drawn.resize(topology.triangles.size() + 1);
  DrawnTriangle* drawn = raster.drawn.data();
  for (int row = 0; row < topology.num_triangles(); ++row) {
    const auto& corners = topology.triangles[row];
    Lanes<T> p0, p1, p2;
    LoadLanes(&vertices[corners[0]].x, p0);
    LoadLanes(&vertices[corners[1]].x, p1);
    LoadLanes(&vertices[corners[2]].x, p2);
    const Lanes<T> a = p1 - p0, b = p2 - p0;
    const T area = a[0] * b[1] - b[0] * a[1];
    const int side = (area < 0) - (area > 0);  // 0 for NaN.
    raster.facing[row] = static_cast<int8_t>(side);
    // Pixels whose centres may be between the least and the greatest coordinate, cut to the picture.
    Lanes<T> low = p0 < p1 ? p0 : p1, high = p0 > p1 ? p0 : p1;
    low = low < p2 ? low : p2, high = high > p2 ? high : p2;
    const Lanes<T> both = {low[0], low[1], high[0], high[1]};
    Lanes<T> cut = both > none ? both : none;  // NaN becomes 0.
    cut = cut < largest ? cut : largest;
    const Bounds rounded = __builtin_convertvector(cut + half, Bounds);
    // cut + 1/2 may have been rounded up: then the first pixel is the one before.
    const int left = rounded[0] - (T(rounded[0]) - T(0.5) >= cut[0] ? 1 : 0);
    const int top = rounded[1] - (T(rounded[1]) - T(0.5) >= cut[1] ? 1 : 0);
    *drawn = {row, std::max(left, 0), std::max(top, 0), std::min(rounded[2], raster.width) - 1,
              std::min(rounded[3], raster.height) - 1};
    drawn += (side != 0) & (side >= least_side) & (drawn->left <= drawn->right) & (drawn->top <= drawn->bottom);
  }
  raster.drawn.resize(drawn - raster.drawn.data());
}

}  // namespace

template <class T>
void FindVisibleTriangles(const MeshTopology& topology, const T* positions, int height, int width, Facing facing,
                          Raster<T>& raster) {
  DAUMIER_CHECK(std::min(height, width) >= 1 && std::max(height, width) <= kMaxPictureSide,
                "the picture is {} x {}, expected sides of 1..{} pixels", height, width, kMaxPictureSide);
  raster.height = height, raster.width = width;
  raster.triangle.assign(raster.num_pixels(), -1);
  raster.depth.assign(raster.num_pixels(), std::numeric_limits<T>::infinity());
  raster.facing.resize(topology.triangles.size());
  ToScreen(positions, topology.num_vertices, raster.vertices);
  BoundTriangles(topology, facing, raster);
  const ScreenVertex<T>* const vertices = raster.vertices.data();
  for (const DrawnTriangle& drawn : raster.drawn) {
    const auto& corners = topology.triangles[drawn.row];
    const int turned = raster.facing[drawn.row] > 0 ? 1 : 0;
    TrianglePainter<T>(vertices[corners[0]], vertices[corners[1 + turned]], vertices[corners[2 - turned]], drawn.row,
                       raster)
        .Paint(drawn.left, drawn.right, drawn.top, drawn.bottom);
  }
}

template void FindVisibleTriangles(const MeshTopology&, const float*, int, int, Facing, Raster<float>&);
template void FindVisibleTriangles(const MeshTopology&, const double*, int, int, Facing, Raster<double>&);

}  // namespace daumier::raster
