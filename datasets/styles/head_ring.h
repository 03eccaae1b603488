#pragma once
#include "datasets/styles/face_shape.h"

#include <vector>

namespace daumier::datasets {

/// The border of a head by angles about a middle at the height of the eyes: 0 degrees is up, positive angles turn to
/// the right of the picture. Its radii are those of the head without hair and ears.
class HeadRing {
 public:
  explicit HeadRing(const FaceShape& shape);

  const Eigen::Vector2d& middle() const { return middle_; }
  double Radius(double degrees) const;
  /// The point at an angle and a share of the radius there: 0 the middle, 1 the border.
  Eigen::Vector2d At(double degrees, double share) const;
  double AngleOf(const Eigen::Vector2d& point) const;
  /// Distance from the middle over the radius at its angle.
  double ShareOf(const Eigen::Vector2d& point) const;
  /// A line at angles between two, `count` points at shares of the radius that `share(t)` gives, t from 0 to 1.
  template <class Share>
  Polyline Arc(double from, double to, int count, const Share& share) const {
    Polyline arc;
    for (int i = 0; i < count; ++i) {
      const double t = double(i) / (count - 1);
      arc.push_back(At(from + (to - from) * t, share(t)));
    }
    return arc;
  }

 private:
  static constexpr int kBins = 72;
  Eigen::Vector2d middle_;
  std::vector<double> radii_;
};

}  // namespace daumier::datasets
