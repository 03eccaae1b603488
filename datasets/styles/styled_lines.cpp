#include "datasets/styles/styled_lines.h"

#include <algorithm>

namespace daumier::datasets {
namespace {

/// The pieces of a line that are kept, with their labels and anchors.
std::vector<StyledLine> LinesOf(const StyledLine& line, const std::vector<LinePiece>& pieces) {
  std::vector<StyledLine> lines;
  for (const LinePiece& piece : pieces) {
    StyledLine kept{line.part, piece.points, {}, {}, line.care, line.width, false};
    faces::LineLabel label = line.labels.front();
    // A cut has the label of the point behind it.
    for (size_t i = piece.origin.size(); i-- > 0;)
      if (piece.origin[i] >= 0) label = line.labels[size_t(piece.origin[i])];
    for (size_t i = 0; i < piece.origin.size(); ++i) {
      if (piece.origin[i] >= 0) label = line.labels[size_t(piece.origin[i])];
      kept.labels.push_back(label);
      for (const LineAnchor& anchor : line.anchors)
        if (anchor.index == piece.origin[i]) kept.anchors.push_back({anchor.point, static_cast<int>(i)});
    }
    lines.push_back(std::move(kept));
  }
  return lines;
}

}  // namespace

StyledLine& LineSheet::Add(DrawnPart part, faces::LineLabel label, Polyline points, std::vector<LineAnchor> anchors) {
  if (points.size() < 2) return unused_ = {};
  std::vector<faces::LineLabel> labels(points.size(), label);
  lines.push_back({part, std::move(points), std::move(labels), std::move(anchors)});
  return lines.back();
}

StyledLine& LineSheet::AddMark(DrawnPart part, faces::LineLabel label, Polyline points) {
  StyledLine& line = Add(part, label, std::move(points));
  line.care = LineCare::kMark;
  return line;
}

void LineSheet::CutInside(const Polyline& polygon, size_t begin, size_t end) {
  std::vector<StyledLine> kept(lines.begin(), lines.begin() + static_cast<ptrdiff_t>(begin));
  for (size_t i = begin; i < end; ++i) {
    const StyledLine& line = lines[i];
    if (line.filled) {
      const auto inside = std::count_if(line.points.begin(), line.points.end(),
                                        [&](const Eigen::Vector2d& p) { return IsInside(polygon, p); });
      if (2 * inside < static_cast<ptrdiff_t>(line.points.size())) kept.push_back(line);
      continue;
    }
    for (StyledLine& piece : LinesOf(line, Outside(line.points, polygon))) kept.push_back(std::move(piece));
  }
  kept.insert(kept.end(), lines.begin() + static_cast<ptrdiff_t>(end), lines.end());
  lines = std::move(kept);
  for (size_t side = 0; side < 2; ++side) {
    const bool is_there =
        std::any_of(lines.begin(), lines.end(), [&](const StyledLine& line) { return line.part == EyePart(side); });
    if (!is_there || (eye_centres[side] && IsInside(polygon, *eye_centres[side]))) eye_centres[side].reset();
    if (!eye_centres[side]) eyes[side].reset();
  }
}

void LineSheet::Move(const std::function<Eigen::Vector2d(const Eigen::Vector2d&)>& moved) {
  for (StyledLine& line : lines)
    for (Eigen::Vector2d& point : line.points) point = moved(point);
  for (auto& centre : eye_centres)
    if (centre) centre = moved(*centre);
}

DrawnPart EyePart(size_t side) {
  return side == 0 ? DrawnPart::kEyeRight : DrawnPart::kEyeLeft;
}

}  // namespace daumier::datasets
