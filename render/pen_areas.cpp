#include "render/pen_areas.h"

#include "core/error.h"
#include "render/stroke_samples.h"
#include "render/swept_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

/// Width of a pen as a share of the sheet's longer side.
constexpr double kMaxPenShare = 0.06;
/// Width of a line along which a pen was swept without doubt, in that of a pen.
constexpr double kMaxSweptWidths = 2.0;
/// Length of the middle lines of a dot, in its widths, from which they replace its outline.
constexpr double kLeastDotLength = 0.5;
/// Pixels in all, and pairs of an area and paper over it, from which on all areas are traced in one picture.
constexpr double kMaxPixelsInAll = 1.5e8;
constexpr size_t kMaxPairs = 200'000;
/// Outlines in all of which the line along which they were swept is searched.
constexpr size_t kMaxSweptOutlines = 4000;
/// Share of the points of two sets of lines that must be near the other set if they are to agree.
constexpr double kAgreeingShare = 0.95;
/// Points by which that is found.
constexpr int kNumSamples = 200;

double DistanceToSegments(const Vector2d& point, const std::vector<Stroke>& strokes) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Stroke& stroke : strokes) {
    for (size_t i = 0; i < stroke.points.size(); ++i) {
      const auto& [x, y] = stroke.points[i];
      const auto& [u, v] = stroke.points[std::min(i + 1, stroke.points.size() - 1)];
      const Vector2d from(x, y), along = Vector2d(u, v) - from;
      const double length = along.squaredNorm();
      const double t = length > 0.0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0.0;
      nearest = std::min(nearest, (point - from - t * along).norm());
    }
  }
  return nearest;
}

/// The share of the length of `from` that lies within a distance of `to`; 0 if either has no length.
double ShareNear(const std::vector<Stroke>& from, const std::vector<Stroke>& to, double distance) {
  const auto has_length = [](const Stroke& stroke) {
    return std::any_of(stroke.points.begin(), stroke.points.end(),
                       [&](const auto& point) { return point != stroke.points[0]; });
  };
  if (std::none_of(from.begin(), from.end(), has_length)) return 0.0;
  int num_near = 0;
  for (const StrokeSample& sample : SampleStrokes(from, kNumSamples)) {
    num_near += DistanceToSegments({sample.x, sample.y}, to) <= distance;
  }
  return static_cast<double>(num_near) / kNumSamples;
}

double LengthOfAll(const std::vector<Stroke>& strokes) {
  double length = 0.0;
  for (const Stroke& stroke : strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      length +=
          std::hypot(stroke.points[i][0] - stroke.points[i - 1][0], stroke.points[i][1] - stroke.points[i - 1][1]);
    }
  }
  return length;
}

/// Areas that are traced together, and their pieces.
struct Group {
  std::vector<size_t> areas;
  std::vector<AreaPiece> pieces;
};

class PenAreas {
 public:
  PenAreas(const std::vector<PaintedArea>& areas, double side) : areas_(areas), max_width_(kMaxPenShare * side) {}

  std::vector<std::vector<Stroke>> Strokes() {
    MakeGroups();
    for (Group& group : groups_) group.pieces = PiecesOf(group);
    JoinShortAreas();
    const double max_dot = kMaxDotWidths * PenWidthOfAll();
    std::vector<std::vector<Stroke>> strokes(areas_.size());
    for (const Group& group : groups_) {
      const size_t owner = group.areas.front();
      strokes[owner] = StrokesOf(group, max_dot);
      for (Stroke& stroke : strokes[owner]) stroke.kind = areas_[owner].kind;
    }
    return strokes;
  }

 private:
  /// Each area is a group, unless that takes too long.
  void MakeGroups() {
    double num_pixels = 0.0;
    size_t num_pairs = 0;
    for (size_t i = 0; i < areas_.size(); ++i) {
      boxes_.push_back(areas_[i].shape.Box());
      if (boxes_.back().isEmpty()) continue;
      if (areas_[i].paint == Paint::kPaper) {
        papers_.push_back(i);
        continue;
      }
      groups_.push_back({{i}, {}});
      num_pixels += NumPixelsFor(areas_[i].shape);
    }
    for (const Group& group : groups_) num_pairs += NumPapersFrom(group.areas.front());
    if (num_pixels <= kMaxPixelsInAll && num_pairs <= kMaxPairs) return;
    Group all;
    for (const Group& group : groups_) all.areas.push_back(group.areas.front());
    groups_ = {all};
  }

  /// Of the papers that are painted after an area.
  size_t NumPapersFrom(size_t area) const {
    return static_cast<size_t>(papers_.end() - std::upper_bound(papers_.begin(), papers_.end(), area));
  }

  /// Areas with the paper over them, in the order in which they are painted.
  std::vector<const PaintedArea*> LayersOf(const std::vector<size_t>& members) const {
    AlignedBox2d box;
    for (const size_t member : members) box.extend(boxes_[member]);
    std::vector<size_t> layers = members;
    for (auto paper = papers_.end() - static_cast<int64_t>(NumPapersFrom(members.front())); paper != papers_.end();
         ++paper) {
      if (boxes_[*paper].intersects(box)) layers.push_back(*paper);
    }
    std::sort(layers.begin(), layers.end());
    std::vector<const PaintedArea*> result;
    for (const size_t layer : layers) result.push_back(&areas_[layer]);
    return result;
  }

  /// The pieces of a group. What paper is painted over shows no more than what is left of it.
  std::vector<AreaPiece> PiecesOf(const Group& group) {
    const auto layers = LayersOf(group.areas);
    if (layers.size() != 1) return FindAreaPieces(layers, max_width_);
    const PaintedArea& area = *layers.front();
    PaintedArea rest = area;
    std::vector<AreaPiece> swept_pieces;
    std::erase_if(rest.shape.outlines, [&](const std::vector<Vector2d>& outline) {
      if (++num_swept_outlines_ > kMaxSweptOutlines) return false;
      const auto swept = LineOfSweptOutline(outline);
      if (!swept || swept->width > kMaxSweptWidths * max_width_) return false;
      swept_pieces.push_back({PieceShape::kLine, swept->width, swept->pen_width, swept->length, {swept->line}, {}, {}});
      return true;
    });
    if (swept_pieces.empty()) return FindAreaPieces(layers, max_width_);
    std::vector<AreaPiece> pieces = FindAreaPieces({&rest}, max_width_);
    for (AreaPiece& piece : pieces) piece.areas = {&area};
    pieces.insert(pieces.end(), swept_pieces.begin(), swept_pieces.end());
    return pieces;
  }

  /// A brush can be drawn as many short areas that touch.
  void JoinShortAreas() {
    Group joint;
    for (const Group& group : groups_) {
      const bool is_short = std::all_of(group.pieces.begin(), group.pieces.end(), [&](const AreaPiece& piece) {
        return piece.shape == PieceShape::kCompact && piece.width <= max_width_;
      });
      if (is_short && !group.pieces.empty() && group.areas.size() == 1) joint.areas.push_back(group.areas.front());
    }
    if (joint.areas.size() < 2) return;
    joint.pieces = FindAreaPieces(LayersOf(joint.areas), max_width_);
    std::erase_if(joint.pieces, [](const AreaPiece& piece) { return piece.shape == PieceShape::kCompact; });
    if (joint.pieces.empty()) return;
    std::set<const PaintedArea*> joined;
    for (const AreaPiece& piece : joint.pieces) joined.insert(piece.areas.begin(), piece.areas.end());
    const auto is_joined = [&](size_t area) { return joined.contains(&areas_[area]); };
    std::erase_if(groups_, [&](const Group& group) { return is_joined(group.areas.front()); });
    std::erase_if(joint.areas, [&](size_t area) { return !is_joined(area); });
    groups_.push_back(std::move(joint));
  }

  /// The median over the length of all lines; 0 if there is none.
  double PenWidthOfAll() const {
    std::vector<std::array<double, 2>> widths_and_lengths;
    double half = 0.0;
    for (const Group& group : groups_) {
      for (const AreaPiece& piece : group.pieces) {
        if (piece.shape == PieceShape::kCompact) continue;
        widths_and_lengths.push_back({piece.pen_width, piece.length});
        half += 0.5 * piece.length;
      }
    }
    std::sort(widths_and_lengths.begin(), widths_and_lengths.end());
    for (const auto& [width, length] : widths_and_lengths) {
      half -= length;
      if (half <= 0.0) return width;
    }
    return 0.0;
  }

  std::vector<Stroke> StrokesOf(const Group& group, double max_dot) const {
    std::vector<Stroke> lines, outlines;
    double width = 0.0;
    for (const AreaPiece& piece : group.pieces) {
      const bool is_line = piece.shape == PieceShape::kLine ||
                           (piece.width <= max_dot && LengthOfAll(piece.lines) >= kLeastDotLength * piece.width);
      auto& strokes = is_line ? lines : outlines;
      const auto& found = is_line ? piece.lines : piece.outlines;
      strokes.insert(strokes.end(), found.begin(), found.end());
      if (is_line) width = std::max(width, piece.width);
    }
    const PaintedArea& first = areas_[group.areas.front()];
    // Without an inside that can be drawn.
    if (group.pieces.empty() && LayersOf(group.areas).size() == 1) outlines = StrokesThrough(first.shape.outlines);
    if (group.areas.size() == 1 && !lines.empty() && !first.drawn_lines.empty()) {
      const auto drawn = StrokesThrough(first.drawn_lines);
      if (Agree(lines, drawn, width)) lines = drawn;
    }
    lines.insert(lines.end(), outlines.begin(), outlines.end());
    return lines;
  }

  static bool Agree(const std::vector<Stroke>& a, const std::vector<Stroke>& b, double distance) {
    return ShareNear(a, b, distance) >= kAgreeingShare && ShareNear(b, a, distance) >= kAgreeingShare;
  }

  const std::vector<PaintedArea>& areas_;
  double max_width_;
  std::vector<AlignedBox2d> boxes_;
  std::vector<size_t> papers_;
  std::vector<Group> groups_;
  size_t num_swept_outlines_ = 0;
};

}  // namespace

std::vector<std::vector<Stroke>> StrokesOfAreas(const std::vector<PaintedArea>& areas, double side) {
  DAUMIER_CHECK(side > 0.0, "areas on a sheet of {} pixels, expected a positive size", side);
  return PenAreas(areas, side).Strokes();
}

}  // namespace daumier::render
