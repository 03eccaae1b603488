#pragma once
#include "datasets/styles/polylines.h"

namespace daumier::datasets {

/// A pen that is steered. Angles are radians, clockwise on the screen (y down); points are at most kStep apart.
class PathPen {
 public:
  static constexpr double kStep = 0.01;

  explicit PathPen(double heading = 0) : heading_(heading) {}

  PathPen& Forward(double length);
  /// Turns on the spot.
  PathPen& Turn(double angle);
  /// Turns by an angle on a circle: a full turn ends where it began.
  PathPen& Arc(double angle, double radius);
  /// Straight to a point, which gives the heading.
  PathPen& To(const Eigen::Vector2d& point);

  const Polyline& points() const { return points_; }
  const Eigen::Vector2d& at() const { return points_.back(); }
  double heading() const { return heading_; }

 private:
  Polyline points_ = {Eigen::Vector2d::Zero()};
  double heading_;
};

/// The line turned about the origin.
Polyline Turned(Polyline line, double angle);
/// The line turned so that its last point lies in that direction from the first. Of a closed line any direction.
Polyline Aimed(const Polyline& line, double angle);
Polyline Scaled(Polyline line, double x, double y);

/// Uniform in the logarithm.
double LogUniform(double low, double high, Rng& rng);
/// Of either sign, its absolute value uniform.
double Signed(double low, double high, Rng& rng);
/// 1 or -1.
double EitherSign(Rng& rng);

}  // namespace daumier::datasets
