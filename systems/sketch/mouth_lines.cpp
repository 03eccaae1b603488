#include "systems/sketch/mouth_lines.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace daumier::sketch {
namespace {

using Eigen::Vector2d;
using enum faces::LineLabel;

constexpr std::array<faces::LineLabel, 3> kLabelsOfLines = {kUpperLip, kInnerMouth, kLowerLip};
constexpr double kLeastWidth = 8;    // Pixels: lines of a smaller mouth cannot be distinguished.
constexpr double kMouthReach = 0.9;  // Widths above and below the corners.
constexpr size_t kLeastThreeCuts = 6, kLeastTwoCuts = 7;
constexpr double kHighestMiddle = -0.1, kLowestMiddle = 0.16, kLeastUpperShare = 0.15, kMostUpperShare = 0.65;
constexpr double kRaisedLip = -0.06, kLevelMiddle = 0.08;
constexpr double kThinnestLips = 0.1, kThickestLips = 0.3, kShareOfUpperLip = 0.45;
constexpr double kSureOfTeeth = 0.5;
constexpr double kShareOfStroke = 0.8;  // Of its points on one line, from which a stroke belongs to it.

bool ShowsMouth(faces::LineLabel label) {
  return label == kUpperLip || label == kLowerLip || label == kInnerMouth;
}

/// From the right corner of the mouth to the left one x is 0 to 1; y is down from there, in widths of the mouth.
class MouthFrame {
 public:
  explicit MouthFrame(const ParsedDrawing& drawing)
      : origin_(drawing.points[size_t(faces::FacePoint::kMouthRight)]),
        along_(drawing.points[size_t(faces::FacePoint::kMouthLeft)] - origin_),
        width_on_canvas_(drawing.frame.scale * along_.norm()) {}

  Vector2d Of(const Vector2d& p) const {
    const Vector2d from = p - origin_;
    return Vector2d(along_.dot(from), along_.x() * from.y() - along_.y() * from.x()) / along_.squaredNorm();
  }
  Vector2d Place(double x, double y) const { return origin_ + x * along_ + y * Vector2d(-along_.y(), along_.x()); }
  double width_on_canvas() const { return width_on_canvas_; }

 private:
  Vector2d origin_, along_;
  double width_on_canvas_;
};

Vector2d PointOf(const render::Stroke& stroke, size_t i) {
  return {stroke.points[i][0], stroke.points[i][1]};
}

struct LineOnCut {
  double y;
  faces::LineLabel label;
  int num_merged = 1;
};

/// The lines that a cut meets, from above.
std::vector<LineOnCut> LinesOnCut(const ParsedDrawing& drawing, const MouthFrame& mouth, double x) {
  std::vector<LineOnCut> met;
  for (size_t s = 0; s < drawing.strokes.size(); ++s) {
    const render::Stroke& stroke = drawing.strokes[s];
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      const faces::LineLabel before = drawing.labels[s][i - 1], after = drawing.labels[s][i];
      if (!ShowsMouth(before) && !ShowsMouth(after)) continue;
      const Vector2d a = mouth.Of(PointOf(stroke, i - 1)), b = mouth.Of(PointOf(stroke, i));
      if ((a.x() <= x) == (b.x() <= x)) continue;
      const double t = (x - a.x()) / (b.x() - a.x()), y = a.y() + t * (b.y() - a.y());
      if (std::abs(y) <= kMouthReach) met.push_back({y, t < 0.5 ? before : after});
    }
  }
  std::ranges::sort(met, {}, &LineOnCut::y);
  std::vector<LineOnCut> lines;
  for (const LineOnCut& line : met) {
    if (lines.empty() || (line.y - lines.back().y) * mouth.width_on_canvas() >= kSameLine) {
      lines.push_back(line);
      continue;
    }
    LineOnCut& last = lines.back();
    last.y = (last.num_merged * last.y + line.y) / (last.num_merged + 1);
    last.label = line.label;
    ++last.num_merged;
  }
  return lines;
}

/// Which of the three lines a place in the mouth's frame is nearest to: beyond the outer cuts they run straight to the
/// corners. Absent beyond these, and where the nearest cut does not meet them.
std::optional<size_t> NearestLine(const ClosedMouthLines& lines, const Vector2d& place) {
  constexpr double kStep = kMouthCuts[1] - kMouthCuts[0];
  const double x = place.x(), first = kMouthCuts.front(), last = kMouthCuts.back();
  if (x <= 0 || x >= 1) return std::nullopt;
  const auto& of_cut = lines[size_t(std::round((std::clamp(x, first, last) - first) / kStep))];
  if (std::isnan(of_cut[0])) return std::nullopt;
  const double share = std::min({x / first, 1.0, (1 - x) / (1 - last)});
  return size_t(std::ranges::min_element(of_cut, {}, [&](double y) { return std::abs(share * y - place.y()); }) -
                of_cut.begin());
}

void LabelLines(const ClosedMouthLines& lines, const MouthFrame& mouth, ParsedDrawing& drawing) {
  for (size_t s = 0; s < drawing.strokes.size(); ++s) {
    std::vector<faces::LineLabel>& labels = drawing.labels[s];
    std::vector<std::optional<size_t>> of_points(labels.size());
    std::array<size_t, 3> counts = {};
    for (size_t i = 0; i < labels.size(); ++i) {
      if (!ShowsMouth(labels[i])) continue;
      of_points[i] = NearestLine(lines, mouth.Of(PointOf(drawing.strokes[s], i)));
      if (of_points[i]) ++counts[*of_points[i]];
    }
    const auto most = size_t(std::ranges::max_element(counts) - counts.begin());
    const size_t sum = counts[0] + counts[1] + counts[2];
    const bool is_one = sum > 0 && double(counts[most]) >= kShareOfStroke * double(sum);
    for (size_t i = 0; i < labels.size(); ++i) {
      if (!ShowsMouth(labels[i])) continue;
      if (is_one) {
        labels[i] = kLabelsOfLines[most];
      } else if (of_points[i]) {
        labels[i] = kLabelsOfLines[*of_points[i]];
      }
    }
  }
}

using MouthCuts = std::array<std::vector<LineOnCut>, kMouthCuts.size()>;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 3> kNoLines = {kNone, kNone, kNone};

std::optional<ClosedMouthLines> ThreeLines(const MouthCuts& cuts) {
  ClosedMouthLines result;
  result.fill(kNoLines);
  size_t num_three = 0;
  std::array<double, 3> mean = {};
  double upper_labels = 0, lower_labels = 0;
  for (size_t cut = 0; cut < cuts.size(); ++cut) {
    const std::vector<LineOnCut>& lines = cuts[cut];
    if (lines.size() < 3) continue;
    ++num_three;
    for (size_t i = 0; i < 3; ++i) {
      result[cut][i] = lines[i].y;
      mean[i] += lines[i].y;
    }
    upper_labels += lines[0].label == kUpperLip ? 1 : 0;
    lower_labels += lines[2].label == kLowerLip ? 1 : 0;
  }
  if (num_three < kLeastThreeCuts) return std::nullopt;
  for (double& y : mean) y /= double(num_three);
  const double upper_share = (mean[1] - mean[0]) / (mean[2] - mean[0]);
  const bool is_level = mean[1] >= kHighestMiddle && mean[1] <= kLowestMiddle && upper_share >= kLeastUpperShare &&
                        upper_share <= kMostUpperShare;
  const bool are_lips = 2 * upper_labels > double(num_three) && 2 * lower_labels > double(num_three);
  const bool is_raised = mean[0] < kRaisedLip && mean[1] < kLevelMiddle;
  if (!is_level || !(are_lips || is_raised)) return std::nullopt;
  return result;
}

std::optional<ClosedMouthLines> Outline(const MouthCuts& cuts) {
  ClosedMouthLines result;
  result.fill(kNoLines);
  size_t num_two = 0;
  double mean_upper = 0, thickness = 0;
  for (size_t cut = 0; cut < cuts.size(); ++cut) {
    if (cuts[cut].size() < 2) continue;
    const double upper = cuts[cut][0].y, lower = cuts[cut][1].y;
    result[cut] = {upper, upper + kShareOfUpperLip * (lower - upper), lower};
    ++num_two;
    mean_upper += upper;
    thickness = std::max(thickness, lower - upper);
  }
  if (num_two < kLeastTwoCuts || mean_upper / double(num_two) >= kRaisedLip) return std::nullopt;
  if (thickness < kThinnestLips || thickness > kThickestLips) return std::nullopt;
  return result;
}

}  // namespace

std::optional<ClosedMouthLines> FindClosedMouthLines(const ParsedDrawing& drawing) {
  const MouthFrame mouth(drawing);
  if (!(mouth.width_on_canvas() >= kLeastWidth)) return std::nullopt;
  MouthCuts cuts;
  size_t most = 0;
  for (size_t cut = 0; cut < cuts.size(); ++cut) {
    cuts[cut] = LinesOnCut(drawing, mouth, kMouthCuts[cut]);
    most = std::max(most, cuts[cut].size());
  }
  if (most == 3) return ThreeLines(cuts);
  if (most == 2) return Outline(cuts);
  return std::nullopt;
}

void ReadMouthLines(ParsedDrawing& drawing) {
  using enum faces::MouthState;
  if (drawing.mouth[size_t(kTeeth)] >= kSureOfTeeth) return;
  const std::optional<ClosedMouthLines> lines = FindClosedMouthLines(drawing);
  if (!lines) return;
  double& closed = drawing.mouth[size_t(kClosed)];
  if (closed < kClosedByLines) {
    const double others = (1 - kClosedByLines) / (1 - closed);
    drawing.mouth[size_t(kOpen)] *= others;
    drawing.mouth[size_t(kTeeth)] *= others;
    closed = kClosedByLines;
  }
  const MouthFrame mouth(drawing);
  // The middle line at the cut with lines that is nearest to the middle.
  std::optional<size_t> middle;
  for (size_t cut = 0; cut < kMouthCuts.size(); ++cut) {
    if (std::isnan((*lines)[cut][1])) continue;
    if (!middle || std::abs(kMouthCuts[cut] - 0.5) < std::abs(kMouthCuts[*middle] - 0.5)) middle = cut;
  }
  const Vector2d seam = mouth.Place(kMouthCuts[*middle], (*lines)[*middle][1]);
  for (const auto point : {faces::FacePoint::kInnerTop, faces::FacePoint::kInnerBottom})
    drawing.points[size_t(point)] = seam;
  LabelLines(*lines, mouth, drawing);
}

}  // namespace daumier::sketch
