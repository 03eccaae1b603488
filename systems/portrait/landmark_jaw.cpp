#include "systems/portrait/landmark_jaw.h"

#include "core/error.h"
#include "systems/portrait/landmark_sample.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::portrait {
namespace {

constexpr int kStepsOfAHalf = 8;

/// Places the points between `first` and first + 8 at equal distances along the polyline of `from`.
void EvenHalf(std::span<const float> from, int first, std::vector<float>& to) {
  const auto at = [&](int k) { return Eigen::Vector2d(from[2 * size_t(first + k)], from[2 * size_t(first + k) + 1]); };
  std::vector<double> along = {0};
  for (int k = 1; k <= kStepsOfAHalf; ++k) along.push_back(along.back() + (at(k) - at(k - 1)).norm());
  int segment = 0;
  for (int k = 1; k < kStepsOfAHalf; ++k) {
    const double place = along.back() * k / kStepsOfAHalf;
    while (segment + 1 < kStepsOfAHalf && along[size_t(segment) + 1] < place) ++segment;
    const double length = along[size_t(segment) + 1] - along[size_t(segment)];
    const double share = length > 0 ? (place - along[size_t(segment)]) / length : 0;
    const Eigen::Vector2d point = at(segment) + share * (at(segment + 1) - at(segment));
    to[2 * size_t(first + k)] = float(point.x());
    to[2 * size_t(first + k) + 1] = float(point.y());
  }
}

}  // namespace

std::vector<float> EvenJaw(std::span<const float> landmarks) {
  DAUMIER_CHECK(landmarks.size() == 2 * size_t(kNumLandmarks), "{} numbers of landmarks, expected {}", landmarks.size(),
                2 * kNumLandmarks);
  std::vector<float> even(landmarks.begin(), landmarks.end());
  EvenHalf(landmarks, 0, even);
  EvenHalf(landmarks, kStepsOfAHalf, even);
  return even;
}

}  // namespace daumier::portrait
