#include "fitting/stroke_matches.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace daumier::fitting {
namespace {

using Eigen::Vector2d;
using faces::LineLabel;

bool HasCurve(LineLabel label) {
  switch (label) {
    case LineLabel::kIris:
    case LineLabel::kWrinkle:
    case LineLabel::kHair:
    case LineLabel::kNeck:
    case LineLabel::kOther:
      return false;
    default:
      return true;
  }
}

Vector2d ToVector(const std::array<float, 2>& point) {
  return {point[0], point[1]};
}

double LengthOf(const LabelledDrawing& drawing) {
  double length = 0;
  for (const LabelledStroke& stroke : drawing.strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i)
      length += HasCurve(stroke.labels[i]) ? (ToVector(stroke.points[i]) - ToVector(stroke.points[i - 1])).norm() : 0;
  }
  return length;
}

/// Whether a label's lines show this curve.
bool Shows(LineLabel label, const LabelCurve& curve, const std::array<bool, 2>& closed_eyes) {
  const bool is_lid = curve.label == LineLabel::kUpperLid || curve.label == LineLabel::kLowerLid;
  if (is_lid && closed_eyes[size_t(curve.side)])
    return curve.label == LineLabel::kLowerLid && (label == LineLabel::kUpperLid || label == LineLabel::kLowerLid);
  return label == curve.label;
}

bool IsInside(const Vector2d& point, const std::vector<int>& polygon, const Eigen::MatrixX2d& projected) {
  bool inside = false;
  for (size_t i = 0; i + 1 < polygon.size(); ++i) {
    const Vector2d a = projected.row(polygon[i]), b = projected.row(polygon[i + 1]);
    if ((a.y() > point.y()) != (b.y() > point.y()) &&
        point.x() < a.x() + (point.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
      inside = !inside;
  }
  return inside;
}

bool IsAtEnd(const faces::PolylinePlace& place, const LabelCurve& curve) {
  if (curve.closed) return false;
  return (place.from == curve.vertices.front() && place.share <= 0) ||
         (place.to == curve.vertices.back() && place.share >= 1);
}

}  // namespace

std::vector<StrokeSample> SampleStrokes(const LabelledDrawing& drawing, double step, size_t most) {
  step = std::max(step, LengthOf(drawing) / double(most));
  std::vector<StrokeSample> samples;
  if (step <= 0) return samples;
  double until_next = step / 2;
  for (const LabelledStroke& stroke : drawing.strokes) {
    for (size_t i = 1; i < stroke.points.size(); ++i) {
      if (!HasCurve(stroke.labels[i])) continue;
      const Vector2d from = ToVector(stroke.points[i - 1]), along = ToVector(stroke.points[i]) - from;
      const double length = along.norm();
      if (length <= 0) continue;
      for (; until_next <= length && samples.size() < most; until_next += step)
        samples.push_back({from + along * (until_next / length), along / length, stroke.labels[i]});
      until_next -= length;
    }
  }
  return samples;
}

std::vector<StrokeMatch> MatchStrokes(const std::vector<StrokeSample>& samples, const std::vector<LabelCurve>& curves,
                                      const Eigen::MatrixX2d& projected, const StrokeMatchOptions& options) {
  std::vector<StrokeMatch> matches;
  for (const StrokeSample& sample : samples) {
    std::optional<StrokeMatch> best;
    double least = options.reach;
    for (const LabelCurve& curve : curves) {
      if (!Shows(sample.label, curve, options.closed_eyes)) continue;
      if (curve.closed && IsInside(sample.position, curve.vertices, projected)) {
        best.reset();
        break;
      }
      const faces::PolylinePlace place = faces::NearestOnPolyline(curve.vertices, projected, sample.position);
      const Vector2d from = projected.row(place.from), to = projected.row(place.to);
      const double distance = (from + place.share * (to - from) - sample.position).norm();
      if (distance >= least) continue;
      const double length = (to - from).norm();
      if (length <= 0 || IsAtEnd(place, curve)) continue;
      const Vector2d along = (to - from) / length;
      if (std::abs(along.dot(sample.direction)) < options.least_cosine) continue;
      least = distance;
      best = StrokeMatch{place, sample.position, {-along.y(), along.x()}, curve.trust};
    }
    if (best) matches.push_back(*best);
  }
  return matches;
}

}  // namespace daumier::fitting
