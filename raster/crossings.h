#pragma once
#include "raster/visibility.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace daumier::raster {

struct AntialiasOptions {
  double depth_margin = 30;  ///< Depth by which the surface may come nearer within a pixel of its silhouette.
  double least_gap = 0.5;    ///< Depth by which what lies outside of a silhouette has to be farther away.

  bool operator==(const AntialiasOptions&) const = default;
};

/// A silhouette edge between the centres of two neighbouring pixels, `pixel` and `next` (right of it or below it).
template <class T>
struct Crossing {
  int pixel = 0, next = 0;
  int first = 0, second = 0;  ///< Vertices of the edge.
  T alpha = 0;                ///< 1/2 - distance of the crossing from the centre of `pixel`; -1/2..1/2.
  T share = 0;   ///< Of the second vertex: the crossing is at (1 - share) p_first + share p_second in the picture.
  T weight = 0;  ///< The same on the surface; differs from `share` in perspective.
  T slope = 0;   ///< Of the edge: displacement along the pair for one pixel across it; -1..1.
  bool is_vertical = false;      ///< The pair is one above the other.
  bool surface_is_next = false;  ///< The surface is on the side of `next`.

  int outside() const { return surface_is_next ? pixel : next; }
  /// G of raster/antialias.h: the area of a pixel beyond the edge, whose distance from its border is -a.
  T Area(T a) const {
    const T width = std::abs(slope);
    return 2 * std::abs(a) >= width ? (a > 0 ? a : T(0)) : (a + width / 2) * (a + width / 2) / (2 * width);
  }
  /// G'(alpha); that of -alpha is 1 - AreaSlope().
  T AreaSlope() const {
    const T width = std::abs(slope);
    return 2 * std::abs(alpha) >= width ? (alpha > 0 ? T(1) : T(0)) : T(0.5) + alpha / width;
  }
};

/// What FindCrossings needs, kept for its next call.
template <class T>
struct CrossingMemory {
  std::vector<int> crossing_of_pair;  ///< 2 x H x W, -1 between calls: pairs to the right, pairs downwards.
};

/// Silhouettes for edge-driven antialiasing. An edge is on a silhouette if it has one visible triangle, or two of
/// opposite facing. It is followed over the rows of pixel centres that it crosses, if it is steep, else over the columns.
/// A crossing counts if the pixel outside of the surface shows nothing, or something farther away than the edge by
/// least_gap, and the pixel on the surface's side shows something that is not nearer than the edge by more than
/// depth_margin. Of several crossings between two pixels the outermost counts. In the order of edges. Depths are those
/// of raster/camera.h, about a pixel each.
/// Rules that search the edges of the triangles that pixels show miss silhouettes of triangles smaller than a pixel.
template <class T>
void FindCrossings(const MeshTopology& topology, const Raster<T>& raster, Facing facing,
                   const AntialiasOptions& options, CrossingMemory<T>& memory, std::vector<Crossing<T>>& crossings);

/// Adds to position_gradient (V x 4) the gradients by the crossing's place, -alpha, and by its weight.
template <class T>
inline void CrossingBackward(const Crossing<T>& crossing, const Raster<T>& raster, T place_gradient, T weight_gradient,
                             T* position_gradient) {
  const int along = crossing.is_vertical ? 1 : 0, across = 1 - along;
  const T line = T(0.5) + T(crossing.is_vertical ? crossing.pixel % raster.width : crossing.pixel / raster.width);
  const ScreenVertex<T>&p = raster.vertices[crossing.first], &q = raster.vertices[crossing.second];
  // weight = a / (a - b) with a, b the ends' homogeneous distances from the line of pixel centres.
  const T a = ((crossing.is_vertical ? p.x : p.y) - line) / p.inverse_w;
  const T b = ((crossing.is_vertical ? q.x : q.y) - line) / q.inverse_w;
  const T by_difference = weight_gradient / (a - b);
  const auto add = [&](int vertex, const ScreenVertex<T>& at, T place_share, T weight_share) {
    T g[2];
    g[along] = place_gradient * place_share * at.inverse_w;
    g[across] = -crossing.slope * g[along];
    T* const to = position_gradient + 4 * int64_t(vertex);
    to[3] -= at.x * g[0] + at.y * g[1] + line * weight_share;
    g[across] += weight_share;
    to[0] += g[0];
    to[1] += g[1];
  };
  add(crossing.first, p, 1 - crossing.share, (1 - crossing.weight) * by_difference);
  add(crossing.second, q, crossing.share, crossing.weight * by_difference);
}

}  // namespace daumier::raster
