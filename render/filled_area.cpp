#include "render/filled_area.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Where an outline crosses the centres of a row of pixels, and its sense there.
struct RowCrossing {
  float x;
  int turn;  ///< +1 downwards, -1 upwards.
};

/// An edge by its upper and lower end.
struct OutlineEdge {
  Vector2d top, bottom;
  int turn, first_row, end_row;  ///< Rows whose centres lie in [top, bottom).

  double XAt(double y) const { return top.x() + (bottom.x() - top.x()) * ((y - top.y()) / (bottom.y() - top.y())); }
};

/// The first row whose centre is not above y, within the mask.
int RowFrom(double y, int height) {
  return static_cast<int>(std::clamp(std::ceil(y - 0.5), 0.0, static_cast<double>(height)));
}

/// The edges that cross the centre of any row of the mask, by their first row.
std::vector<OutlineEdge> EdgesOf(const FilledArea& area, const MaskFrame& frame, int height) {
  std::vector<OutlineEdge> edges;
  for (const auto& outline : area.outlines) {
    for (size_t i = 0; i < outline.size(); ++i) {
      const Vector2d from = frame.scale * (outline[i] - frame.origin);
      const Vector2d to = frame.scale * (outline[(i + 1) % outline.size()] - frame.origin);
      DAUMIER_CHECK(from.allFinite(), "point {} of an outline is not finite", i);
      const bool is_down = from.y() < to.y();
      OutlineEdge edge{is_down ? from : to, is_down ? to : from, is_down ? 1 : -1, 0, 0};
      edge.first_row = RowFrom(edge.top.y(), height);
      edge.end_row = RowFrom(edge.bottom.y(), height);
      if (edge.first_row < edge.end_row) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const OutlineEdge& a, const OutlineEdge& b) { return a.first_row < b.first_row; });
  return edges;
}

void FillRow(const std::vector<RowCrossing>& crossings, FillRule rule, uint8_t value, uint8_t* row, int width) {
  int winding = 0;
  for (size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].turn;
    const bool is_inside = rule == FillRule::kNonzero ? winding != 0 : winding % 2 != 0;
    if (!is_inside) continue;
    const auto column_from = [&](float x) { return std::clamp(std::ceil(x - 0.5F), 0.0F, static_cast<float>(width)); };
    const auto first = static_cast<int>(column_from(crossings[i].x));
    const auto end = static_cast<int>(column_from(crossings[i + 1].x));
    std::fill(row + first, row + std::max(first, end), value);
  }
}

}  // namespace

Eigen::AlignedBox2d FilledArea::Box() const {
  Eigen::AlignedBox2d box;
  for (const auto& outline : outlines) {
    for (const Vector2d& point : outline) box.extend(point);
  }
  return box;
}

void FillArea(const FilledArea& area, const MaskFrame& frame, uint8_t value, Image& mask) {
  DAUMIER_CHECK(mask.channels == 1, "an area is to be drawn into {} channels, expected 1", mask.channels);
  const auto edges = EdgesOf(area, frame, mask.height);
  std::vector<OutlineEdge> active;
  std::vector<RowCrossing> crossings;
  size_t next = 0;
  for (int row = 0; row < mask.height && (next < edges.size() || !active.empty()); ++row) {
    std::erase_if(active, [&](const OutlineEdge& edge) { return edge.end_row <= row; });
    while (next < edges.size() && edges[next].first_row <= row) active.push_back(edges[next++]);
    crossings.clear();
    for (const OutlineEdge& edge : active) crossings.push_back({static_cast<float>(edge.XAt(row + 0.5)), edge.turn});
    std::sort(crossings.begin(), crossings.end(), [](const RowCrossing& a, const RowCrossing& b) { return a.x < b.x; });
    FillRow(crossings, area.rule, value, mask.pixels.data() + size_t(row) * mask.width, mask.width);
  }
}

}  // namespace daumier::render
