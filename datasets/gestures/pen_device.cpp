#include "datasets/gestures/pen_device.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

using Eigen::Vector2d;

/// The cursor of a mouse whose gain rises with its speed. The eye corrects it: it returns to the intended way within
/// about a tenth of a second.
Polyline Accelerated(const Polyline& path, double acceleration) {
  const double mean = std::max(LengthOf(path) / static_cast<double>(path.size()), 1e-9);
  Polyline cursor = {path.front()};
  double speed = mean;
  for (size_t i = 1; i < path.size(); ++i) {
    const Vector2d step = path[i] - path[i - 1];
    speed += 0.05 * (step.norm() - speed);
    const double gain = std::clamp(1 + acceleration * (speed / mean - 1), 0.6, 1.6);
    const Vector2d point = cursor.back() + gain * step;
    cursor.push_back(point + 0.01 * (path[i] - point));
  }
  return cursor;
}

Polyline ExponentiallySmoothed(Polyline path, double time_ms) {
  for (size_t i = 1; i < path.size(); ++i) path[i] = path[i - 1] + (path[i] - path[i - 1]) / (1 + time_ms);
  return path;
}

Vector2d OnGrid(const Vector2d& point, double grid) {
  if (grid <= 0) return point;
  return {grid * std::round(point.x() / grid), grid * std::round(point.y() / grid)};
}

}  // namespace

PenDevice DrawPenDevice(Rng& rng) {
  PenDevice device;
  const double choice = rng.Uniform();
  if (choice < 0.35) {
    device.rate_hz = rng.Uniform(120, 200);
    device.grid_px = Happens(0.5, rng) ? 0 : 0.05;
  } else if (choice < 0.7) {
    device.kind = PenDeviceKind::kMouse;
    device.rate_hz = rng.Uniform(60, 125);
    device.grid_px = 1;
    device.acceleration = rng.Uniform(0, 0.3);
  } else if (choice < 0.88) {
    device.kind = PenDeviceKind::kTouch;
    device.rate_hz = 60;
    device.grid_px = Happens(0.5, rng) ? 1 : 0.25;
    device.smoothing_ms = rng.Uniform(4, 25);
    device.slop_px = Happens(0.5, rng) ? rng.Uniform(2, 6) : 0;
  } else {
    device.kind = PenDeviceKind::kSlowMachine;
    device.rate_hz = rng.Uniform(40, 60);
    device.grid_px = 1;
    device.loss = rng.Uniform(0, 0.15);
  }
  return device;
}

Polyline SamplePen(const Polyline& by_millisecond, const PenDevice& device, Rng& rng) {
  DAUMIER_CHECK(!by_millisecond.empty(), "a movement of the pen has no points");
  Polyline path = by_millisecond;
  if (device.acceleration > 0) path = Accelerated(path, device.acceleration);
  if (device.smoothing_ms > 0) path = ExponentiallySmoothed(path, device.smoothing_ms);
  Polyline reported = {OnGrid(path.front(), device.grid_px)};
  const double period_ms = 1000 / device.rate_hz, last = static_cast<double>(path.size() - 1);
  bool moved = false;
  double time = period_ms * rng.Uniform(0.2, 1);
  for (bool lifted = false; !lifted; time += period_ms * rng.Uniform(0.85, 1.15)) {
    lifted = time >= last;
    const bool lost = Happens(device.loss, rng);
    if (lost && !lifted) continue;
    const Vector2d& point = path[static_cast<size_t>(std::min(time, last))];
    moved = moved || lifted || (point - path.front()).norm() > device.slop_px;
    const Vector2d rounded = OnGrid(point, device.grid_px);
    if (moved && rounded != reported.back()) reported.push_back(rounded);
  }
  if (reported.size() < 2) reported.push_back(reported.back());
  return reported;
}

}  // namespace daumier::datasets
