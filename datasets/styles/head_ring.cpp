#include "datasets/styles/head_ring.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

/// The distance from `middle` along `direction` at which it meets the polygon last; 0 if it does not.
double ReachOf(const Polyline& polygon, const Eigen::Vector2d& middle, const Eigen::Vector2d& direction) {
  double reach = 0;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Eigen::Vector2d edge = polygon[i] - polygon[j], arm = polygon[j] - middle;
    const double cross = direction.x() * edge.y() - direction.y() * edge.x();
    if (std::abs(cross) < 1e-12) continue;
    const double along = (arm.x() * edge.y() - arm.y() * edge.x()) / cross;
    const double across = (arm.x() * direction.y() - arm.y() * direction.x()) / cross;
    if (across >= 0 && across <= 1) reach = std::max(reach, along);
  }
  return reach;
}

}  // namespace

HeadRing::HeadRing(const FaceShape& shape) {
  const Polyline head = shape.head();
  const Polyline& crown = shape.skull.empty() ? shape.outline : shape.skull;
  middle_ = {BoxOf(crown).center().x(), shape.eyes_middle.y()};
  for (int i = 0; i < kBins; ++i) {
    const double angle = 2 * std::numbers::pi * i / kBins;
    radii_.push_back(std::max(ReachOf(head, middle_, {std::sin(angle), -std::cos(angle)}), 0.2 * shape.unit));
  }
}

double HeadRing::Radius(double degrees) const {
  const double place = degrees / 360 * kBins, floor = std::floor(place);
  const auto bin = [&](double i) {
    const auto index = static_cast<int64_t>(i) % kBins;
    return radii_[size_t(index < 0 ? index + kBins : index)];
  };
  return bin(floor) + (place - floor) * (bin(floor + 1) - bin(floor));
}

Eigen::Vector2d HeadRing::At(double degrees, double share) const {
  const double angle = degrees * std::numbers::pi / 180;
  return middle_ + share * Radius(degrees) * Eigen::Vector2d(std::sin(angle), -std::cos(angle));
}

double HeadRing::AngleOf(const Eigen::Vector2d& point) const {
  const Eigen::Vector2d arm = point - middle_;
  return std::atan2(arm.x(), -arm.y()) * 180 / std::numbers::pi;
}

double HeadRing::ShareOf(const Eigen::Vector2d& point) const {
  return (point - middle_).norm() / Radius(AngleOf(point));
}

}  // namespace daumier::datasets
