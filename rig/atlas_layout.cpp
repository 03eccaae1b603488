#include "rig/atlas_layout.h"

#include "core/error.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace daumier::rig {
namespace {

/// Lower left corners of boxes in the unit square, highest box first: in shelves from the bottom, each with columns from
/// the left, in which a box lies on the one before if it fits. None if they do not fit.
std::optional<std::vector<Eigen::Vector2d>> PlaceBoxes(const std::vector<Eigen::Vector2d>& boxes) {
  struct Column {
    double left, width, used;
  };
  struct Shelf {
    double bottom, height, used;
    std::vector<Column> columns;
  };
  std::vector<size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return boxes[a].y() > boxes[b].y(); });
  std::vector<Shelf> shelves;
  std::vector<Eigen::Vector2d> corners(boxes.size());
  double top = 0;
  const auto place = [&](size_t box, Shelf& shelf) {
    const double width = boxes[box].x(), height = boxes[box].y();
    for (Column& column : shelf.columns) {
      if (width > column.width || column.used + height > shelf.height) continue;
      corners[box] = {column.left, shelf.bottom + column.used};
      column.used += height;
      return true;
    }
    if (shelf.used + width > 1) return false;
    corners[box] = {shelf.used, shelf.bottom};
    shelf.columns.push_back({shelf.used, width, height});
    shelf.used += width;
    return true;
  };
  for (const size_t box : order) {
    if (std::any_of(shelves.begin(), shelves.end(), [&](Shelf& shelf) { return place(box, shelf); })) continue;
    shelves.push_back({top, boxes[box].y(), 0, {}});
    top += boxes[box].y();
    if (top > 1 || !place(box, shelves.back())) return std::nullopt;
  }
  return corners;
}

}  // namespace

std::vector<geometry::TextureCoordinates> LayOut(const std::vector<AtlasPiece>& pieces, double gutter) {
  std::vector<Eigen::Vector2d> extents;
  for (const AtlasPiece& piece : pieces) {
    extents.push_back((piece.uv.colwise().maxCoeff() - piece.uv.colwise().minCoeff()).transpose());
    DAUMIER_CHECK(extents.back().minCoeff() > 0 && piece.size > 0, "a piece of the atlas has no extent");
    extents.back() *= piece.size / extents.back().maxCoeff();
  }
  const auto place = [&](double factor) {
    std::vector<Eigen::Vector2d> boxes;
    for (const Eigen::Vector2d& extent : extents) boxes.emplace_back(factor * extent.array() + gutter);
    return PlaceBoxes(boxes);
  };
  // The greatest factor that fits, to a thousandth.
  double low = 0, high = 2 / std::max_element(pieces.begin(), pieces.end(), [](const auto&a, const auto&b) {
                               return a.size < b.size;
                             })->size;
  DAUMIER_CHECK(place(low).has_value(), "{} gutters of {} fill the atlas", pieces.size(), gutter);
  while (high - low > 1e-3 * high) {
    const double middle = 0.5 * (low + high);
    (place(middle) ? low : high) = middle;
  }
  const std::vector<Eigen::Vector2d> corners = *place(low);
  std::vector<geometry::TextureCoordinates> placed;
  for (size_t i = 0; i < pieces.size(); ++i) {
    const Eigen::RowVector2d from = pieces[i].uv.colwise().minCoeff();
    const double longest = (pieces[i].uv.colwise().maxCoeff() - from).maxCoeff();
    placed.emplace_back((pieces[i].uv.rowwise() - from) * (low * pieces[i].size / longest));
    placed.back().rowwise() += corners[i].transpose() + Eigen::RowVector2d::Constant(0.5 * gutter);
  }
  return placed;
}

}  // namespace daumier::rig
