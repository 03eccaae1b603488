#pragma once
#include "core/random.h"
#include "datasets/styles/polylines.h"

/// What a program receives of a movement of the pen.
namespace daumier::datasets {

enum class PenDeviceKind {
  kTablet,      ///< Fast, fractions of a pixel.
  kMouse,       ///< Whole pixels; fast movements go farther.
  kTouch,       ///< Smoothed; nothing is reported until the finger has moved a few pixels.
  kSlowMachine  ///< Few positions, some of them lost.
};

struct PenDevice {
  PenDeviceKind kind = PenDeviceKind::kTablet;
  double rate_hz = 150;
  double grid_px = 0;       ///< Coordinates are multiples of it; 0: as they are.
  double acceleration = 0;  ///< Of a mouse: gain per relative difference from the mean speed.
  double smoothing_ms = 0;  ///< Time constant.
  double slop_px = 0;       ///< Movements up to this far from the first point are not reported.
  double loss = 0;          ///< Share of the positions that are lost.
};

PenDevice DrawPenDevice(Rng& rng);

/// The reported positions of a movement given at each millisecond: at least two, no neighbours equal unless the pen
/// rests all the time. @throws Error if the movement has no points.
Polyline SamplePen(const Polyline& by_millisecond, const PenDevice& device, Rng& rng);

}  // namespace daumier::datasets
