#pragma once
#include "raster/visibility.h"

#include <cstdint>
#include <vector>

namespace daumier::raster {

struct AntialiasOptions {
  double depth_margin = 15;  ///< Depth by which the surface may come nearer within a pixel of its silhouette.
  double least_gap = 0.5;    ///< Depth by which what lies outside of a silhouette has to be farther away.

  bool operator==(const AntialiasOptions&) const = default;
};

/// A silhouette edge between the centres of two neighbouring pixels, `pixel` and `next` (right of it or below it). With
/// d in [0, 1] the distance of the crossing from the first centre, alpha = 1/2 - d. The picture c changes by
/// out[target] += alpha (c[next] - c[pixel]); the target is `pixel` where alpha > 0, else `next`.
template <class T>
struct Crossing {
  int pixel = 0, next = 0;
  int first = 0, second = 0;  ///< Vertices of the edge.
  T alpha = 0;
  T share = 0;  ///< Of the second vertex: the crossing is at (1 - share) p_first + share p_second in the picture.
  T slope = 0;  ///< Of the edge: displacement along the pair for one pixel across it; -1..1.
  bool is_vertical = false;  ///< The pair is one above the other.

  int target() const { return alpha > 0 ? pixel : next; }
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

/// picture, antialiased: num_pixels x num_channels, not the same memory. Blends all crossings, reading `picture` alone.
template <class T>
void Antialias(const std::vector<Crossing<T>>& crossings, int64_t num_pixels, int num_channels, const T* picture,
               T* antialiased);

/// Adds the gradient of sum(antialiased * antialiased_gradient) to picture_gradient (H x W x num_channels) and to
/// position_gradient (V x 4; its third column is unchanged). With D the sum over channels of
/// gradient[target] (c[next] - c[pixel]), and x along the pair:
///   dL/dx_first = -D (1 - share), dL/dx_second = -D share, dL/dy = -slope dL/dx.
template <class T>
void AntialiasBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                       const T* picture, const T* antialiased_gradient, T* picture_gradient, T* position_gradient);

/// The part of AntialiasBackward that a crossing adds to position_gradient, given D.
template <class T>
void CrossingBackward(const Crossing<T>& crossing, const Raster<T>& raster, T weighted_difference,
                      T* position_gradient);

}  // namespace daumier::raster
