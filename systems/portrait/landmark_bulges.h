#pragma once
#include "core/random.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace daumier::portrait {

/// A part of a crop that is shown larger (zoom < 0) or smaller, and moved, pixels of the crop.
struct Bulge {
  Eigen::Vector2d centre;
  double radius = 1;
  double zoom = 0;  ///< -0.9 to 0.9
  Eigen::Vector2d shift = {0, 0};
};

/// A smooth change of shape of a crop: where a point p of the new crop comes from in the old one,
///   q = p + sum w(|p - c| / r) (zoom (p - c) + shift),  w(s) = (1 - s^2)^2 for s < 1, else 0.
/// Caricatures by parts, for training.
class Bulges {
 public:
  explicit Bulges(std::vector<Bulge> bulges = {}) : bulges_(std::move(bulges)) {}

  bool empty() const { return bulges_.empty(); }
  Eigen::Vector2d SourceOf(const Eigen::Vector2d& p) const;
  /// Where a point of the old crop comes to: undoes SourceOf to 0.01 pixels, where the sum of |zoom| is below 0.9 and shifts
  /// are below a quarter of the radius.
  Eigen::Vector2d PlaceOf(const Eigen::Vector2d& q) const;
  /// q - p at the centres of size x size pixels of the crop: all x, then all y; `cells` x `cells` squares of a crop of that size.
  std::vector<float> Field(int size, int cells) const;

 private:
  std::vector<Bulge> bulges_;
};

/// One to three bulges around landmarks (mouth, eyes, nose, chin, forehead) of a crop, 68 x 2 pixels: mouth and chin larger
/// more often than smaller. strength: 1 for zooms of up to 0.45 in sum 0.8.
Bulges DrawBulges(std::span<const float> landmarks, double strength, Rng& rng);

}  // namespace daumier::portrait
