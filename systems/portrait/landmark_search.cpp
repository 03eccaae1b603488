#include "systems/portrait/landmark_search.h"

#include "core/error.h"
#include "systems/portrait/landmark_views.h"

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

constexpr double kMostLogSide = 4;  // A box is at most e^4 cells wide, whatever the network returns.

double Sigmoid(double score) {
  return 1 / (1 + std::exp(-score));
}

}  // namespace

std::vector<CropFrame> SearchSquares(int height, int width, int size, int level) {
  DAUMIER_CHECK(height > 0 && width > 0 && level >= 0, "a search in a picture of {} x {} at level {}", height, width,
                level);
  const double whole = std::max(height, width), side = whole / (1 << level);
  if (level == 0) return {{.centre = {0.5 * width, 0.5 * height}, .side = side, .size = size}};
  std::vector<CropFrame> squares;
  const int steps = 2 * ((1 << level) - 1);
  const double left = 0.5 * (width - whole), top = 0.5 * (height - whole);
  for (int row = 0; row <= steps; ++row)
    for (int column = 0; column <= steps; ++column) {
      const Eigen::Vector2d centre(left + 0.5 * side * (column + 1), top + 0.5 * side * (row + 1));
      const double reach = 0.5 * side;
      if (centre.x() + reach <= 0 || centre.y() + reach <= 0 || centre.x() - reach >= width ||
          centre.y() - reach >= height)
        continue;
      squares.push_back({.centre = centre, .side = side, .size = size});
    }
  return squares;
}

std::vector<FoundBox> BoxesOfMap(std::span<const float> map, const CropFrame& frame, double least_score) {
  const int side = SearchSide(frame.size);
  const size_t cells = size_t(side) * size_t(side);
  DAUMIER_CHECK(map.size() == 5 * cells, "a search map has {} numbers, expected {}", map.size(), 5 * cells);
  const auto score_at = [&](int row, int column) { return map[size_t(row) * size_t(side) + size_t(column)]; };
  std::vector<FoundBox> boxes;
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) {
      const float score = score_at(row, column);
      if (Sigmoid(score) < least_score) continue;
      bool is_peak = true;
      for (int r = std::max(0, row - 1); r <= std::min(side - 1, row + 1); ++r)
        for (int c = std::max(0, column - 1); c <= std::min(side - 1, column + 1); ++c) {
          const bool comes_first = r < row || (r == row && c < column);
          if (score_at(r, c) > score || (comes_first && score_at(r, c) == score)) is_peak = false;
        }
      if (!is_peak) continue;
      const size_t at = size_t(row) * size_t(side) + size_t(column);
      const double cell = double(frame.size) / side;
      const Eigen::Vector2d in_crop =
          cell * Eigen::Vector2d(column + 0.5 + map[cells + at], row + 0.5 + map[2 * cells + at]);
      const Eigen::Vector2d centre = frame.ToPicture(in_crop);
      const auto length = [&](size_t k) {
        return cell * frame.scale() * std::exp(std::clamp(double(map[k * cells + at]), -kMostLogSide, kMostLogSide));
      };
      const double width = length(3), height = length(4);
      boxes.push_back(
          {{centre.x() - 0.5 * width, centre.y() - 0.5 * height, centre.x() + 0.5 * width, centre.y() + 0.5 * height},
           Sigmoid(score)});
    }
  return boxes;
}

std::vector<FoundBox> WithoutDoubles(std::vector<FoundBox> boxes, double most_overlap) {
  std::ranges::stable_sort(boxes, [](const FoundBox& a, const FoundBox& b) { return a.score > b.score; });
  std::vector<FoundBox> kept;
  for (const FoundBox& box : boxes)
    if (std::ranges::none_of(kept, [&](const FoundBox& other) { return Overlap(other.box, box.box) > most_overlap; }))
      kept.push_back(box);
  return kept;
}

}  // namespace daumier::portrait
