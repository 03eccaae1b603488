#include "datasets/gestures/path_pen.h"

#include <algorithm>
#include <cmath>

namespace daumier::datasets {

using Eigen::Vector2d;

PathPen& PathPen::Forward(double length) {
  return To(at() + length * Vector2d(std::cos(heading_), std::sin(heading_)));
}

PathPen& PathPen::Turn(double angle) {
  heading_ += angle;
  return *this;
}

PathPen& PathPen::Arc(double angle, double radius) {
  constexpr double kAngleStep = 0.1;
  const double largest = std::max(std::abs(angle) / kAngleStep, std::abs(angle) * radius / kStep);
  const int count = std::max(1, static_cast<int>(std::ceil(largest)));
  const double side = angle < 0 ? -1 : 1, start = heading_;
  const Vector2d centre = at() + side * radius * Vector2d(-std::sin(start), std::cos(start));
  for (int i = 1; i <= count; ++i) {
    heading_ = start + angle * i / count;
    points_.push_back(centre - side * radius * Vector2d(-std::sin(heading_), std::cos(heading_)));
  }
  return *this;
}

PathPen& PathPen::To(const Vector2d& point) {
  const Vector2d from = at(), way = point - from;
  if (way.norm() == 0) return *this;
  heading_ = std::atan2(way.y(), way.x());
  const int count = std::max(1, static_cast<int>(std::ceil(way.norm() / kStep)));
  for (int i = 1; i <= count; ++i) points_.push_back(from + way * (double(i) / count));
  return *this;
}

Polyline Turned(Polyline line, double angle) {
  const Eigen::Rotation2Dd rotation(angle);
  for (Vector2d& point : line) point = rotation * point;
  return line;
}

Polyline Aimed(const Polyline& line, double angle) {
  const Vector2d way = line.back() - line.front();
  return Turned(line, angle - std::atan2(way.y(), way.x()));
}

Polyline Scaled(Polyline line, double x, double y) {
  for (Vector2d& point : line) point = {x * point.x(), y * point.y()};
  return line;
}

double LogUniform(double low, double high, Rng& rng) {
  return low * std::pow(high / low, rng.Uniform());
}

double Signed(double low, double high, Rng& rng) {
  const double sign = EitherSign(rng);
  return sign * rng.Uniform(low, high);
}

double EitherSign(Rng& rng) {
  return rng.Uniform() < 0.5 ? -1 : 1;
}

}  // namespace daumier::datasets
