#include "datasets/gestures/stroke_form.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

constexpr int kMeasuredPoints = 160;

double TurnBetween(const Vector2d& a, const Vector2d& b) {
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

/// Largest distance of points [begin, end) from the line through the first and the last of them, over their distance.
double DeviationOf(const Polyline& line, size_t begin, size_t end) {
  const Vector2d chord = line[end - 1] - line[begin];
  const double length = chord.norm();
  if (length < 1e-9) return 1e9;
  double largest = 0;
  for (size_t i = begin; i < end; ++i) {
    const Vector2d d = line[i] - line[begin];
    largest = std::max(largest, std::abs(chord.x() * d.y() - chord.y() * d.x()) / length);
  }
  return largest / length;
}

/// A shaft of at least 0.6 of the length that is nearly straight and less than 40 degrees off the level, and all that is
/// left at one end.
bool HasLevelShaft(const Polyline& line) {
  const size_t size = line.size(), shaft = size * 6 / 10;
  for (const size_t begin : {size_t{0}, size - shaft}) {
    const Vector2d chord = line[begin + shaft - 1] - line[begin];
    if (DeviationOf(line, begin, begin + shaft) < 0.1 && std::abs(chord.y()) < 0.84 * std::abs(chord.x())) return true;
  }
  return false;
}

}  // namespace

Polyline Smoothed(const Polyline& stroke, double window, int count) {
  const Polyline even = Resampled(stroke, count);
  const int half = static_cast<int>(std::lround(0.5 * window * count));
  Polyline smooth(even.size());
  for (int i = 0; i < count; ++i) {
    const int reach = std::min({half, i, count - 1 - i});
    Vector2d sum = Vector2d::Zero();
    for (int k = i - reach; k <= i + reach; ++k) sum += even[size_t(k)];
    smooth[size_t(i)] = sum / (2 * reach + 1);
  }
  return smooth;
}

StrokeForm FormOf(const Polyline& stroke) {
  StrokeForm form;
  form.length = LengthOf(stroke);
  DAUMIER_CHECK(form.length > 0, "a stroke of {} points without length has no shape", stroke.size());
  const Vector2d chord = stroke.back() - stroke.front();
  form.gap = chord.norm() / form.length;
  form.deviation = DeviationOf(stroke, 0, stroke.size());
  form.direction = std::atan2(chord.y(), chord.x());
  const Polyline smooth = Smoothed(stroke, 1.0 / 40, kMeasuredPoints);
  double angle = 0;
  for (size_t i = 2; i < smooth.size(); ++i)
    angle += TurnBetween(smooth[i - 1] - smooth[i - 2], smooth[i] - smooth[i - 1]);
  form.turns = angle / (2 * std::numbers::pi);
  return form;
}

bool MayBeGesture(const Polyline& stroke) {
  const StrokeForm form = FormOf(stroke);
  const double turns = std::abs(form.turns);
  if (form.is_nearly_straight()) return true;
  if (form.gap < 0.2 && turns < 1.75) return true;
  const double slant = std::abs(std::sin(2 * form.direction));
  if (turns > 0.6 && turns < 3.5 && slant > 0.25 && form.gap > 0.1) return true;
  return HasLevelShaft(Smoothed(stroke, 1.0 / 40, kMeasuredPoints));
}

}  // namespace daumier::datasets
