#pragma once
#include "raster/mesh_topology.h"
#include "raster/rasterise.h"

#include <array>
#include <cstdint>
#include <vector>

namespace daumier::raster {

struct AntialiasOptions {
  double depth_margin =
      15;                  ///< Depth by which the surface may come nearer within a pixel of its silhouette, in pixels.
  double least_gap = 0.5;  ///< Depth by which what lies outside of a silhouette has to be farther away, in pixels.

  bool operator==(const AntialiasOptions&) const = default;
};

/// A silhouette edge between the centres of two neighbouring pixels, `pixel` and `next` (right of it or below it).
/// The picture changes by out[target] += alpha (c[next] - c[pixel]), alpha = 1/2 - d, d in [0, 1] the distance of the
/// crossing from the first centre; target is `pixel` where alpha > 0, else `next`.
template <class T>
struct Crossing {
  int pixel = 0, next = 0;
  int first = 0, second = 0;  ///< Vertices of the edge.
  T alpha = 0;
  T share = 0;               ///< Of the second vertex: the crossing is at (1 - share) p_first + share p_second.
  T slope = 0;               ///< Of the edge: displacement along the pair for one pixel across it.
  bool is_vertical = false;  ///< The pair is one above the other.

  int target() const { return alpha > 0 ? pixel : next; }
};

/// Memory of FindCrossings, reused by the next call.
template <class T>
struct CrossingMemory {
  std::vector<int> crossing_of_pair;  ///< 2 x H x W; -1 between calls.
  std::vector<T> depths;
};

/// Edge-driven antialiasing. An edge is a silhouette if it has one visible triangle, or two that face differently. It is
/// followed over the lines of pixel centres that it crosses (rows if it is steep, columns otherwise). A crossing counts
/// if the pixel outside of the surface is farther away than the edge by `least_gap` (or shows nothing), and the pixel on
/// the side of the surface shows something that is not nearer than the edge by more than `depth_margin`. Of several
/// crossings between two pixels the outermost one counts. In the order of edges.
/// Unlike rules that search the edges of the triangles that pixels show, it finds silhouettes of triangles that are
/// smaller than a pixel.
template <class T>
void FindCrossings(const MeshTopology& topology, const Raster<T>& raster, Facing facing,
                   const AntialiasOptions& options, CrossingMemory<T>& memory, std::vector<Crossing<T>>& crossings);

/// picture, antialiased: H x W x num_channels; not the same memory.
template <class T>
void Antialias(const std::vector<Crossing<T>>& crossings, int64_t num_pixels, int num_channels, const T* picture,
               T* antialiased);

/// Adds the gradient of sum(antialiased * antialiased_gradient) to picture_gradient (H x W x num_channels) and to
/// position_gradient (V x 4; its third column is unchanged).
template <class T>
void AntialiasBackward(const std::vector<Crossing<T>>& crossings, const Raster<T>& raster, int num_channels,
                       const T* picture, const T* antialiased_gradient, T* picture_gradient, T* position_gradient);

}  // namespace daumier::raster
