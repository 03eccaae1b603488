#pragma once
#include "core/random.h"
#include "datasets/styles/polylines.h"

#include <vector>

/// A kinematic model of the hand: planned points become a movement in time.
namespace daumier::datasets {

/// A point at which the pen is aimed. At a corner the pen slows down; elsewhere its direction turns smoothly.
struct ViaPoint {
  Eigen::Vector2d at;
  bool corner = false;
};
using PenPlan = std::vector<ViaPoint>;

enum class HandModel {
  kLognormal,    ///< Arcs with lognormal speed that overlap in time [Plamondon 1995].
  kMinimumJerk,  ///< Arcs with the speed of least jerk that overlap in time [Flash and Hogan 1985].
  kSpring        ///< A damped mass on a spring, whose other end moves along the arcs.
};

/// The hand of one person. The values here are those of a steady hand. A share without a reference is one of the
/// larger side of the box of the plan.
struct WriterHand {
  HandModel model = HandModel::kMinimumJerk;
  double tempo_s = 0.12;      ///< Duration of a movement of 80 pixels.
  double overlap = 0.35;      ///< Share of a movement's duration during which the next one has begun, at smooth points.
  double corner_overlap = 0;  ///< The same at corners.
  double skewness = 0.25;     ///< Of the lognormal speed.
  double spring_hz = 6, damping = 0.7;
  double aim_noise = 0;     ///< Deviation of an end point, share of the distance to it.
  double correction = 0.6;  ///< Share of an error that the next movement removes.
  double bend_noise = 0;    ///< Deviation of the bend of an arc, radians.
  double tremor_px = 0, tremor_hz = 10;
  double drift = 0;      ///< Amplitude of slow wandering, share.
  double landing = 0;    ///< Length of the tick where the pen lands, share.
  double drag = 0;       ///< Length of the tick where the pen leaves, share.
  double cut_start = 0;  ///< Share of the length that leaves no ink at the start.
  double cut_end = 0;    ///< The same at the end.
};

/// A person in a hurry.
WriterHand DrawWriterHand(Rng& rng);

/// The position of the pen at each millisecond. A steady hand starts at the first point of the plan and ends at the
/// last one; a plan of a straight line stays straight. A spring may end before it has settled.
/// @throws Error if the plan has fewer than two points.
Polyline MovePen(const PenPlan& plan, const WriterHand& hand, Rng& rng);

}  // namespace daumier::datasets
