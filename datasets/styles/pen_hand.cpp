#include "datasets/styles/pen_hand.h"

#include "datasets/read/pen_effects.h"
#include "datasets/read/stroke_arc.h"
#include "render/line_reduction.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

constexpr double kSpacing = 3;             ///< Of the points of a stroke, pixels.
constexpr double kBendLength = 45;         ///< Of the shortest error of a whole line, pixels.
constexpr double kDoubleLength = 50;       ///< Over which the second line of a pair comes and goes.
constexpr double kFullOvershoot = 90;      ///< Length of a line whose ends overshoot as far as those of any longer one.
constexpr double kFarthestFromLine = 3.5;  ///< Of a stroke from its line.

/// Points and their labels.
struct LabelledLine {
  Polyline points;
  std::vector<faces::LineLabel> labels;
};

/// The line with points at most kSpacing apart; a new point has the label of the one before it.
LabelledLine Dense(const StyledLine& line) {
  LabelledLine dense;
  for (size_t i = 0; i < line.points.size(); ++i) {
    if (i > 0) {
      const Vector2d step = line.points[i] - line.points[i - 1];
      const int count = std::clamp(static_cast<int>(step.norm() / kSpacing), 0, 200);
      for (int k = 1; k <= count; ++k) {
        dense.points.push_back(line.points[i - 1] + step * k / (count + 1));
        dense.labels.push_back(line.labels[i - 1]);
      }
    }
    dense.points.push_back(line.points[i]);
    dense.labels.push_back(line.labels[i]);
  }
  return dense;
}

/// Each point moved by noise, but no farther than kFarthestFromLine.
void AddNoise(Polyline& points, double rms, double length, Rng& rng) {
  if (rms <= 0 || points.size() < 2) return;
  render::Stroke stroke;
  for (const Vector2d& point : points) stroke.points.push_back(ToPoint(point));
  const render::Stroke noisy = Jitter(stroke, rms, length, rng);
  for (size_t i = 0; i < points.size(); ++i) {
    Vector2d offset = ToVector(noisy.points[i]) - points[i];
    const double distance = offset.norm();
    if (distance > kFarthestFromLine) offset *= kFarthestFromLine / distance;
    points[i] += offset;
  }
}

LabelledLine Span(const LabelledLine& line, size_t begin, size_t end) {
  const auto b = static_cast<ptrdiff_t>(begin), e = static_cast<ptrdiff_t>(end);
  return {Polyline(line.points.begin() + b, line.points.begin() + e),
          std::vector<faces::LineLabel>(line.labels.begin() + b, line.labels.begin() + e)};
}

/// The ends later or earlier along the line's direction.
void Overshoot(LabelledLine& line, double deviation, Rng& rng) {
  if (deviation <= 0 || line.points.size() < 4) return;
  deviation *= std::min(1.0, LengthOf(line.points) / kFullOvershoot);
  for (int end = 0; end < 2; ++end) {
    const double extra = Deviate(deviation, rng);
    if (extra > 0) {
      const Vector2d direction = (line.points.back() - line.points[line.points.size() - 3]);
      if (direction.norm() > 0) {
        line.points.push_back(line.points.back() + extra * direction.normalized());
        line.labels.push_back(line.labels.back());
      }
    } else {
      const auto count = std::min(static_cast<size_t>(-extra / kSpacing), line.points.size() / 6);
      line.points.resize(line.points.size() - count);
      line.labels.resize(line.points.size());
    }
    std::reverse(line.points.begin(), line.points.end());
    std::reverse(line.labels.begin(), line.labels.end());
  }
}

/// Short overlapping pieces, each a little off.
std::vector<LabelledLine> InPieces(const LabelledLine& line, Rng& rng) {
  std::vector<LabelledLine> pieces;
  size_t begin = 0;
  while (begin + 1 < line.points.size()) {
    const size_t count = 6 + rng.Below(12), end = std::min(begin + count, line.points.size());
    LabelledLine piece = Span(line, begin, end);
    const Vector2d shift(Deviate(0.5, rng), Deviate(0.5, rng));
    for (Vector2d& point : piece.points) point += shift;
    pieces.push_back(std::move(piece));
    if (end == line.points.size()) break;
    begin = end - 1 - rng.Below(std::min<uint64_t>(4, end - begin - 1));
  }
  return pieces;
}

/// Two pieces with a gap between them, or the line if it is short.
std::vector<LabelledLine> WithOneGap(const LabelledLine& line, Rng& rng) {
  const size_t count = line.points.size(), gap = 1 + rng.Below(3);
  if (count < 10 + gap) return {line};
  const size_t begin = 3 + rng.Below(count - gap - 6);
  return {Span(line, 0, begin + 1), Span(line, begin + gap, count)};
}

LabelledLine Polygonal(const LabelledLine& line, double tolerance) {
  LabelledLine polygon;
  for (const int i : render::ReducedLine(line.points, tolerance)) {
    polygon.points.push_back(line.points[size_t(i)]);
    polygon.labels.push_back(line.labels[size_t(i)]);
  }
  return polygon;
}

/// The parts of a line on the canvas as strokes.
void AddOnCanvas(const LabelledLine& line, float width, bool filled, std::vector<StyledStroke>& strokes) {
  constexpr double kSide = render::kSketchCanvas;
  static const Polyline kWholeCanvas = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}};
  const auto add = [&](const Polyline& points, const std::vector<faces::LineLabel>& labels) {
    StyledStroke& stroke = strokes.emplace_back(StyledStroke{width, filled, {}, labels});
    for (const Vector2d& point : points) stroke.points.push_back(ToPoint(point.cwiseMax(0).cwiseMin(kSide)));
  };
  const Eigen::AlignedBox2d box = BoxOf(line.points);
  if (box.isEmpty()) return;
  if (box.min().minCoeff() >= 0 && box.max().maxCoeff() <= kSide) return add(line.points, line.labels);
  if (filled) {  // A corner of the area at the border stays at the border.
    const bool is_on = box.min().maxCoeff() < kSide && box.max().minCoeff() > 0;
    if (is_on) add(line.points, line.labels);
    return;
  }
  for (const LinePiece& piece : Inside(line.points, kWholeCanvas)) {
    std::vector<faces::LineLabel> labels;
    faces::LineLabel label = line.labels.front();
    for (size_t i = piece.origin.size(); i-- > 0;)
      if (piece.origin[i] >= 0) label = line.labels[size_t(piece.origin[i])];
    for (const int origin : piece.origin) {
      if (origin >= 0) label = line.labels[size_t(origin)];
      labels.push_back(label);
    }
    add(piece.points, labels);
  }
}

}  // namespace

HandHabits DrawHabits(const HandStyles& styles, bool is_steady, double size, Rng& rng) {
  HandHabits habits;
  habits.width = styles.width * std::exp(Deviate(styles.width_spread, rng));
  if (is_steady) return habits;
  const double scale = std::clamp(size, 0.3, 1.2);
  habits.tremor = styles.tremor_px * scale * rng.Uniform();
  habits.tremor_length = rng.Uniform(4, 22);
  habits.bend = styles.bend_px * scale * rng.Uniform();
  if (Happens(styles.double_strokes, rng)) habits.doubled = rng.Uniform(0.2, 0.9);
  if (Happens(styles.searching, rng)) habits.searching = rng.Uniform(0.3, 1);
  if (Happens(styles.gaps, rng)) habits.gaps = rng.Uniform(0.1, 0.6);
  if (Happens(styles.overshoot, rng)) habits.overshoot = rng.Uniform(1, 5) * scale;
  if (Happens(styles.polygons, rng)) habits.polygon = rng.Uniform(0.4, 2) * scale;
  return habits;
}

void BendLines(LineSheet& sheet, double bend, Rng& rng) {
  for (StyledLine& line : sheet.lines)
    if (line.care != LineCare::kMark && !line.points.empty()) AddNoise(line.points, bend, kBendLength, rng);
}

std::vector<StyledStroke> DrawByHand(const StyledLine& line, const HandHabits& habits, Rng& rng) {
  std::vector<StyledStroke> strokes;
  if (line.points.empty()) return strokes;
  const auto width = static_cast<float>(habits.width * line.width);
  LabelledLine dense = Dense(line);
  if (line.care == LineCare::kMark || line.filled) {
    if (line.care != LineCare::kMark) AddNoise(dense.points, habits.tremor, habits.tremor_length, rng);
    AddOnCanvas(dense, width, line.filled, strokes);
    return strokes;
  }
  std::vector<LabelledLine> pieces = {dense};
  if (line.care == LineCare::kFree) {
    if (Happens(habits.searching, rng)) {
      pieces = InPieces(dense, rng);
    } else if (Happens(habits.doubled, rng)) {
      LabelledLine second = dense;
      AddNoise(second.points, rng.Uniform(0.4, 1.2), kDoubleLength, rng);
      Overshoot(second, 6, rng);
      pieces.push_back(std::move(second));
    } else if (Happens(habits.gaps, rng)) {
      pieces = WithOneGap(dense, rng);
    }
  }
  for (LabelledLine& piece : pieces) {
    Overshoot(piece, line.care == LineCare::kFree ? habits.overshoot : 0.4 * habits.overshoot, rng);
    AddNoise(piece.points, habits.tremor, habits.tremor_length, rng);
    if (habits.polygon > 0) piece = Polygonal(piece, habits.polygon);
    AddOnCanvas(piece, width, false, strokes);
  }
  return strokes;
}

}  // namespace daumier::datasets
