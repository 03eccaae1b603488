#include "raster/crossings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::raster {
namespace {

/// The corner on the surface's side if the edge is on a silhouette, else -1.
int SilhouetteCorner(const MeshEdge& edge, const std::vector<int8_t>& facing, Facing visible) {
  const int a = facing[edge.triangle[0]], b = edge.triangle[1] < 0 ? 0 : facing[edge.triangle[1]];
  if (visible == Facing::kFront) {
    if ((a > 0) == (b > 0)) return -1;
    return a > 0 ? edge.corner[0] : edge.corner[1];
  }
  if (a == b) return -1;
  return a != 0 ? edge.corner[0] : edge.corner[1];
}

/// Follows silhouette edges over lines of pixel centres; `along` is the coordinate of a line, x of a row.
template <class T>
class SilhouetteWalker {
 public:
  SilhouetteWalker(const Raster<T>& raster, const AntialiasOptions& options, CrossingMemory<T>& memory,
                   std::vector<Crossing<T>>& crossings)
      : raster_(raster),
        depth_margin_(T(options.depth_margin)),
        least_gap_(T(options.least_gap)),
        pair_(memory.crossing_of_pair),
        crossings_(crossings) {}

  void Walk(const MeshEdge& edge, int corner) {
    const ScreenVertex<T>&p = raster_.vertices[edge.first], &q = raster_.vertices[edge.second],
          &r = raster_.vertices[corner];
    const T dx = q.x - p.x, dy = q.y - p.y;
    const T turn = dx * (r.y - p.y) - dy * (r.x - p.x);
    if (std::abs(dy) >= std::abs(dx)) {
      if (dy != 0) WalkLines(edge, false, p.x, p.y, dx, dy, p, q, (turn < 0) == (dy > 0));
    } else {
      WalkLines(edge, true, p.y, p.x, dy, dx, p, q, (turn > 0) == (dx > 0));
    }
  }

 private:
  /// surface_is_next: the surface is where `along` grows.
  void WalkLines(const MeshEdge& edge, bool is_vertical, T along, T across, T d_along, T d_across,
                 const ScreenVertex<T>& p, const ScreenVertex<T>& q, bool surface_is_next) {
    const int num_lines = is_vertical ? raster_.width : raster_.height;
    const int num_places = is_vertical ? raster_.height : raster_.width;
    const int step = is_vertical ? raster_.width : 1, line_step = is_vertical ? 1 : raster_.width;
    const T low = std::min(across, across + d_across), high = std::max(across, across + d_across);
    if (!(high > T(0.5)) || !(low < T(num_lines))) return;
    const int begin = low <= T(0.5) ? 0 : static_cast<int>(std::ceil(low - T(0.5)));
    const int end = high > T(num_lines) ? num_lines : static_cast<int>(std::ceil(high - T(0.5)));
    const T slope = d_along / d_across;
    for (int line = begin; line < end; ++line) {
      const T past = T(line) + T(0.5) - across, share = past / d_across;
      const T at = along + past * slope, place = at - T(0.5);
      if (!(place >= 0) || !(place < T(num_places - 1))) continue;
      const int left = static_cast<int>(place);
      const int pixel = left * step + line * line_step, next = pixel + step;
      const int inside = surface_is_next ? next : pixel, outside = surface_is_next ? pixel : next;
      const T edge_depth = p.depth + share * (q.depth - p.depth);
      if (raster_.triangle[inside] < 0) continue;
      if (!(raster_.depth[outside] > edge_depth + least_gap_)) continue;
      if (!(raster_.depth[inside] >= edge_depth - depth_margin_)) continue;
      const T on_second = share * q.inverse_w, weight = on_second / ((1 - share) * p.inverse_w + on_second);
      Keep({pixel, next, edge.first, edge.second, T(0.5) - (place - T(left)), share, weight, slope, is_vertical,
            surface_is_next});
    }
  }

  /// The outermost: that of greatest alpha if the surface is at `next`, of least alpha otherwise.
  void Keep(const Crossing<T>& crossing) {
    int& index = pair_[(crossing.is_vertical ? raster_.num_pixels() : 0) + crossing.pixel];
    if (index < 0) {
      index = static_cast<int>(crossings_.size());
      crossings_.push_back(crossing);
    } else if (crossing.surface_is_next ? crossing.alpha > crossings_[index].alpha
                                        : crossing.alpha < crossings_[index].alpha) {
      crossings_[index] = crossing;
    }
  }

  const Raster<T>& raster_;
  const T depth_margin_, least_gap_;
  std::vector<int>& pair_;
  std::vector<Crossing<T>>& crossings_;
};

}  // namespace

template <class T>
void FindCrossings(const MeshTopology& topology, const Raster<T>& raster, Facing facing,
                   const AntialiasOptions& options, CrossingMemory<T>& memory, std::vector<Crossing<T>>& crossings) {
  crossings.clear();
  if (int64_t(memory.crossing_of_pair.size()) != 2 * raster.num_pixels()) {
    memory.crossing_of_pair.assign(2 * raster.num_pixels(), -1);
  }
  SilhouetteWalker<T> walker(raster, options, memory, crossings);
  for (const MeshEdge& edge : topology.edges) {
    const int corner = SilhouetteCorner(edge, raster.facing, facing);
    if (corner >= 0) walker.Walk(edge, corner);
  }
  for (const Crossing<T>& crossing : crossings) {
    memory.crossing_of_pair[(crossing.is_vertical ? raster.num_pixels() : 0) + crossing.pixel] = -1;
  }
}

template void FindCrossings(const MeshTopology&, const Raster<float>&, Facing, const AntialiasOptions&,
                            CrossingMemory<float>&, std::vector<Crossing<float>>&);
template void FindCrossings(const MeshTopology&, const Raster<double>&, Facing, const AntialiasOptions&,
                            CrossingMemory<double>&, std::vector<Crossing<double>>&);

}  // namespace daumier::raster
