#include "systems/portrait/landmark_bulges.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::portrait {
namespace {

constexpr int kMostSteps = 60;
constexpr double kTolerance = 0.003;

struct BulgePlace {
  int begin, end;  // Landmarks whose mean is the centre.
  double reach;    // Radius over the mean distance of these landmarks from it, or over that of the face.
  bool is_of_face;
  double bias;  // Added to the zoom.
};

// Both eyes, one eye each, nose, mouth, chin, forehead side.
constexpr std::array<BulgePlace, 7> kPlaces = {{{36, 48, 1.8, false, 0},
                                                {36, 42, 3.0, false, -0.05},
                                                {42, 48, 3.0, false, -0.05},
                                                {29, 36, 3.0, false, 0},
                                                {48, 68, 2.2, false, -0.12},
                                                {6, 11, 1.0, true, -0.08},
                                                {17, 27, 0.9, true, 0}}};

Eigen::Vector2d LandmarkAt(std::span<const float> landmarks, int i) {
  return {landmarks[2 * size_t(i)], landmarks[2 * size_t(i) + 1]};
}

/// Mean of landmarks begin..end - 1, and their mean distance from it.
std::pair<Eigen::Vector2d, double> CentreAndReach(std::span<const float> landmarks, int begin, int end) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (int i = begin; i < end; ++i) centre += LandmarkAt(landmarks, i) / (end - begin);
  double reach = 0;
  for (int i = begin; i < end; ++i) reach += (LandmarkAt(landmarks, i) - centre).norm() / (end - begin);
  return {centre, reach};
}

}  // namespace

Eigen::Vector2d Bulges::SourceOf(const Eigen::Vector2d& p) const {
  Eigen::Vector2d source = p;
  for (const Bulge& bulge : bulges_) {
    const Eigen::Vector2d from_centre = p - bulge.centre;
    const double s2 = from_centre.squaredNorm() / (bulge.radius * bulge.radius);
    if (s2 >= 1) continue;
    source += (1 - s2) * (1 - s2) * (bulge.zoom * from_centre + bulge.shift);
  }
  return source;
}

Eigen::Vector2d Bulges::PlaceOf(const Eigen::Vector2d& q) const {
  constexpr double kDamping = 0.7;  // The map shrinks by at most 10 to 1 and enlarges by less than 2.
  Eigen::Vector2d p = q;
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector2d miss = q - SourceOf(p);
    p += kDamping * miss;
    if (miss.squaredNorm() < kTolerance * kTolerance) break;
  }
  return p;
}

std::vector<float> Bulges::Field(int size, int cells) const {
  const size_t count = size_t(cells) * size_t(cells);
  std::vector<float> field(2 * count, 0);
  const double cell = double(size) / cells;
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const Eigen::Vector2d p((column + 0.5) * cell, (row + 0.5) * cell), moved = SourceOf(p) - p;
      const size_t at = size_t(row) * size_t(cells) + size_t(column);
      field[at] = float(moved.x());
      field[count + at] = float(moved.y());
    }
  return field;
}

Bulges DrawBulges(std::span<const float> landmarks, double strength, Rng& rng) {
  DAUMIER_CHECK(landmarks.size() == 136, "bulges are drawn around 68 landmarks, here are {} numbers", landmarks.size());
  constexpr double kMostZoom = 0.45, kMostSum = 0.8, kMostShift = 0.12;
  const double of_face = CentreAndReach(landmarks, 0, 68).second;
  std::vector<Bulge> bulges;
  double sum = 0;
  const int count = 1 + int(rng.Below(3));
  for (int i = 0; i < count; ++i) {
    const BulgePlace& place = kPlaces[size_t(rng.Below(kPlaces.size()))];
    const auto [centre, reach] = CentreAndReach(landmarks, place.begin, place.end);
    Bulge bulge{.centre = centre, .radius = std::max(2.0, place.reach * (place.is_of_face ? of_face : reach))};
    bulge.radius *= rng.Uniform(0.8, 1.4);
    bulge.zoom = std::clamp(strength * (rng.Uniform(-kMostZoom, 0.6 * kMostZoom) + place.bias), -kMostZoom, kMostZoom);
    bulge.shift = strength * kMostShift * bulge.radius * Eigen::Vector2d(rng.Uniform(-1, 1), rng.Uniform(-1, 1));
    sum += std::abs(bulge.zoom);
    if (sum > kMostSum) break;
    bulges.push_back(bulge);
  }
  return Bulges(std::move(bulges));
}

}  // namespace daumier::portrait
