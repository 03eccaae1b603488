#include "datasets/build/portrait_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

constexpr double kBelowMiddle = 0.05;  // Of the picture: hair needs more room than necks.
constexpr int kRounds = 4;

double Radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

/// Normally distributed about 0 with a deviation of 0.4 limit, cut at the limit.
double DrawAngle(double limit, Rng& rng) {
  return std::clamp(0.4 * limit * rng.Normal(), -limit, limit);
}

}  // namespace

std::array<float, 6> DrawPose(const geometry::Points& landmarks, const PortraitOptics& optics,
                              const PoseOptions& options, Rng& rng) {
  const bool is_frontal = rng.Uniform() < options.frontal;
  const double near = DrawAngle(options.yaw / 2, rng), wide = rng.Uniform(-options.yaw, options.yaw);
  std::array<float, 6> pose = {static_cast<float>(Radians(DrawAngle(options.pitch, rng))),
                               static_cast<float>(Radians(is_frontal ? near : wide)),
                               static_cast<float>(Radians(DrawAngle(options.roll, rng)))};
  const double size = optics.size * rng.Uniform(options.smallest, std::max(options.smallest, options.largest));
  const Eigen::Vector2d middle(optics.size * (0.5 + options.shift * rng.Uniform(-1, 1)),
                               optics.size * (0.5 + kBelowMiddle + options.shift * rng.Uniform(-1, 1)));
  for (int round = 0; round < kRounds; ++round) {
    const geometry::Points pixels = render::Project(PortraitCamera(optics, pose), landmarks);
    const Eigen::Vector2d low = pixels.leftCols<2>().colwise().minCoeff(),
                          high = pixels.leftCols<2>().colwise().maxCoeff();
    const double growth = size / (high - low).maxCoeff();
    const double depth = (optics.distance - pose[5]) / growth;
    pose[5] = static_cast<float>(std::clamp(optics.distance - depth, kFarthestPose, kNearestPose));
    const geometry::Points placed = render::Project(PortraitCamera(optics, pose), landmarks);
    const Eigen::Vector2d centre =
        (placed.leftCols<2>().colwise().minCoeff() + placed.leftCols<2>().colwise().maxCoeff()) / 2;
    const Eigen::Vector2d way = (middle - centre) * (optics.distance - pose[5]) / optics.focal;
    pose[3] += static_cast<float>(way.x());
    pose[4] -= static_cast<float>(way.y());
  }
  return pose;
}

}  // namespace daumier::datasets
