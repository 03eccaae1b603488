#include "datasets/gestures/gesture_hand.h"

#include "datasets/gestures/path_pen.h"
#include "datasets/gestures/stroke_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

constexpr int kHandPoints = 400;
constexpr double kScreen = 1200;
/// Greatest angle, radians, that a hand turns between two samples.
constexpr double kSampledTurn = 0.75;

/// Slow waves along the line, of that deviation.
void Bend(Polyline& line, double deviation, Rng& rng) {
  for (const double waves : {0.5, 1.0, 2.0, 3.5}) {
    const Vector2d phase{rng.Uniform(-pi, pi), rng.Uniform(-pi, pi)};
    const Vector2d amplitude = deviation / (0.7 + 0.3 * waves) * Vector2d{rng.Normal(), rng.Normal()};
    for (size_t i = 0; i < line.size(); ++i) {
      const double angle = 2 * pi * waves * double(i) / double(line.size());
      line[i] += Vector2d(amplitude.x() * std::sin(angle + phase.x()), amplitude.y() * std::sin(angle + phase.y()));
    }
  }
}

/// Noise that is alike over some fourteen points.
void Tremble(Polyline& line, double deviation, Rng& rng) {
  Vector2d noise = Vector2d::Zero();
  constexpr double kMemory = 0.93;
  const double step = deviation * std::sqrt(1 - kMemory * kMemory);
  for (Vector2d& point : line) {
    noise = kMemory * noise + step * Vector2d{rng.Normal(), rng.Normal()};
    point += noise;
  }
}

/// A short hook where the pen comes down or leaves.
void AddFlick(Polyline& line, double length, Rng& rng) {
  const Vector2d leaves = line.back() - line[line.size() - 3];
  const double angle = std::atan2(leaves.y(), leaves.x()) + rng.Uniform(-2.2, 2.2);
  const Vector2d from = line.back();
  for (int i = 1; i <= 4; ++i) line.push_back(from + length * i / 4.0 * Vector2d(std::cos(angle), std::sin(angle)));
}

/// When each point is reached, and how much the hand turns on its way, radians.
struct Pace {
  std::vector<double> times;
  double turning = 0;
};

/// A hand is slow where it turns and at both ends.
Pace PaceOf(const Polyline& line, double slowness) {
  Pace pace;
  std::vector<double>& times = pace.times;
  times.assign(line.size(), 0);
  const double length = LengthOf(line);
  for (size_t i = 1; i < line.size(); ++i) {
    const Vector2d step = line[i] - line[i - 1];
    double turn = 0;
    if (i + 1 < line.size()) {
      const Vector2d next = line[i + 1] - line[i];
      turn = std::abs(std::atan2(step.x() * next.y() - step.y() * next.x(), step.dot(next)));
    }
    pace.turning += turn;
    const double share = double(i) / double(line.size()), at_ends = 0.004 / (0.02 + std::min(share, 1 - share));
    times[i] = times[i - 1] + step.norm() / length * (1 + at_ends) + slowness * turn;
  }
  return pace;
}

Polyline SampledInTime(const Polyline& line, const Pace& pace, const GestureHand& hand, double jitter, Rng& rng) {
  const std::vector<double>& times = pace.times;
  const double spacing = Happens(hand.sparse, rng) ? LogUniform(25, 120, rng) : LogUniform(4, 30, rng);
  const int least = 3 + static_cast<int>(pace.turning / kSampledTurn);
  const int count = std::clamp(static_cast<int>(LengthOf(line) / spacing), least, std::max(least, 600));
  Polyline sampled;
  size_t next = 0;
  for (int i = 0; i < count; ++i) {
    const bool is_end = i == 0 || i + 1 == count;
    const double at = times.back() * (i + (is_end ? 0 : jitter * rng.Uniform(-0.5, 0.5))) / (count - 1);
    while (next + 1 < line.size() && times[next + 1] < at) ++next;
    if (next + 1 >= line.size()) {
      sampled.push_back(line.back());
      continue;
    }
    const double span = times[next + 1] - times[next], share = span > 0 ? (at - times[next]) / span : 0;
    sampled.push_back(line[next] + std::clamp(share, 0.0, 1.0) * (line[next + 1] - line[next]));
  }
  return sampled;
}

Polyline WithoutRepeats(const Polyline& line) {
  Polyline distinct;
  for (const Vector2d& point : line)
    if (distinct.empty() || distinct.back() != point) distinct.push_back(point);
  return distinct;
}

}  // namespace

GestureHand DrawGestureHand(const GestureHandOptions& options, Rng& rng) {
  if (options.smallest_px > options.largest_px)
    throw UsageError(
        fmt::format("hand.smallest_px={} is more than hand.largest_px={}", options.smallest_px, options.largest_px));
  const double sloppiness = std::exp(Deviate(0.5, rng));
  return {.bend = options.bend * sloppiness,
          .rounding = options.rounding * sloppiness * LogUniform(0.5, 2, rng),
          .tremor_px = options.tremor_px * LogUniform(0.25, 2.5, rng),
          .has_mouse = Happens(options.mouse, rng),
          .sparse = std::min(1.0, options.sparse * rng.Uniform(0, 2)),
          .smallest_px = options.smallest_px,
          .largest_px = options.largest_px};
}

Polyline DrawWithHand(const Polyline& shape, const GestureHand& hand, Rng& rng) {
  Polyline line = Smoothed(shape, hand.rounding * rng.Uniform(0, 2), kHandPoints);
  const Eigen::AlignedBox2d box = BoxOf(line);
  const double size = LogUniform(hand.smallest_px, hand.largest_px, rng), scale = size / box.sizes().maxCoeff();
  const Vector2d place{rng.Uniform(0, kScreen), rng.Uniform(0, kScreen)};
  for (Vector2d& point : line) point = place + scale * (point - box.min());
  Bend(line, hand.bend * size * rng.Uniform(0, 2), rng);
  if (Happens(0.15, rng)) AddFlick(line, rng.Uniform(0, 0.035) * size, rng);
  if (Happens(0.1, rng)) {
    line = Reversed(line);
    AddFlick(line, rng.Uniform(0, 0.035) * size, rng);
    line = Reversed(line);
  }
  const Pace pace = PaceOf(line, LogUniform(0.02, 0.12, rng));
  // In small strokes a hand trembles less.
  Tremble(line, hand.tremor_px * std::min(1.0, size / 200), rng);
  Polyline sampled = SampledInTime(line, pace, hand, rng.Uniform(0, 0.4), rng);
  if (hand.has_mouse)
    for (Vector2d& point : sampled) point = {std::round(point.x()), std::round(point.y())};
  return WithoutRepeats(sampled);
}

}  // namespace daumier::datasets
