#include "systems/portrait/picture_hair.h"

#include "core/error.h"
#include "core/picture_parts.h"

#include <algorithm>
#include <array>
#include <vector>

namespace daumier::portrait {
namespace {

constexpr double kBandHeight = 0.05;     // Of the sides, along v.
constexpr double kLeastSideHair = 0.12;  // Share of a band that hair must have there.
constexpr double kLeastCrown = 0.15, kLongBelow = -1.15, kBobBelow = -0.65, kFringeBelow = 0.13;
constexpr size_t kLeastHairPixels = 30;
constexpr int kSideBands = 60;  // From v = 0.5 down to -2.5.
constexpr double kFirstBand = 0.5;

/// The frame of a face in its picture.
struct FaceAxes {
  Eigen::Vector2d brows, up, across;
  double height;

  explicit FaceAxes(std::span<const float> landmarks) {
    const auto point = [&](size_t n) { return Eigen::Vector2d(landmarks[2 * n], landmarks[2 * n + 1]); };
    brows = (point(19) + point(21) + point(22) + point(24)) / 4;
    up = brows - point(8);
    height = up.norm();
    DAUMIER_CHECK(height > 0, "the landmarks of chin and brows are one point");
    up /= height;
    across = {-up.y(), up.x()};
  }
  /// (u, v)
  Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const {
    return Eigen::Vector2d(across.dot(pixel - brows), up.dot(pixel - brows)) / height;
  }
};

struct Band {
  double hair = 0, all = 0;
};

/// The lowest v to which hair goes down without a gap of two bands, on one side of the face.
double LowestOf(const std::array<Band, kSideBands>& bands) {
  double lowest = kFirstBand;
  int num_missed = 0;
  bool has_begun = false;
  for (int i = 0; i < kSideBands; ++i) {
    const bool is_hair = bands[size_t(i)].all > 0 && bands[size_t(i)].hair > kLeastSideHair * bands[size_t(i)].all;
    num_missed = is_hair ? 0 : num_missed + 1;
    has_begun = has_begun || is_hair;
    if (is_hair) lowest = kFirstBand - kBandHeight * (i + 1);
    if (has_begun && num_missed > 2) break;
  }
  return lowest;
}

Eigen::Vector3f MedianColourOf(std::array<std::vector<uint8_t>, 3>& channels) {
  Eigen::Vector3f colour;
  for (size_t c = 0; c < 3; ++c) {
    const auto middle = channels[c].begin() + std::ssize(channels[c]) / 2;
    std::ranges::nth_element(channels[c], middle);
    colour[Eigen::Index(c)] = float(*middle) / 255;
  }
  return colour;
}

}  // namespace

ShownHair FindShownHair(const render::Image& picture, const render::Image& mask, std::span<const float> landmarks) {
  DAUMIER_CHECK(landmarks.size() == 136, "hair is found by 68 landmarks, here are {} numbers", landmarks.size());
  DAUMIER_CHECK(mask.height == picture.height && mask.width == picture.width && mask.channels == 1,
                "a mask of {} x {} for a picture of {} x {}", mask.height, mask.width, picture.height, picture.width);
  const FaceAxes axes(landmarks);
  std::array<std::array<Band, kSideBands>, 2> sides;
  std::array<std::vector<uint8_t>, 3> colours;
  Band crown;
  ShownHair found;
  for (int row = 0; row < mask.height; ++row) {
    for (int column = 0; column < mask.width; ++column) {
      const Eigen::Vector2d place = axes({column + 0.5, row + 0.5});
      const double u = std::abs(place.x()), v = place.y();
      const bool is_hair = mask.at(row, column) == uint8_t(PictureClass::kHair);
      if (v > 0.3 && v < 0.7 && u < 0.4) {
        crown.all += 1;
        crown.hair += is_hair;
      }
      if (u > 0.5 && u < 1.1 && v < kFirstBand && v > kFirstBand - kBandHeight * kSideBands) {
        Band& band = sides[place.x() < 0 ? 0 : 1][size_t((kFirstBand - v) / kBandHeight)];
        band.all += 1;
        band.hair += is_hair;
      }
      if (!is_hair || v <= 0) continue;
      if (u < 0.2) found.forehead = std::min(found.forehead, v);
      for (size_t c = 0; c < 3; ++c) colours[c].push_back(picture.at(row, column, picture.channels == 3 ? int(c) : 0));
    }
  }
  found.crown = crown.all > 0 ? crown.hair / crown.all : 0;
  found.length = std::min(LowestOf(sides[0]), LowestOf(sides[1]));
  if (colours[0].size() >= kLeastHairPixels) found.colour = MedianColourOf(colours);
  return found;
}

faces::Looks LooksOf(const ShownHair& hair) {
  faces::Looks looks;
  looks.hair_colour = hair.colour;
  if (hair.crown < kLeastCrown) {
    looks.hair = faces::HairStyle::kBald;
  } else if (hair.length < kLongBelow) {
    looks.hair = faces::HairStyle::kLong;
  } else if (hair.length < kBobBelow) {
    looks.hair = faces::HairStyle::kBob;
  } else {
    looks.hair = hair.forehead < kFringeBelow ? faces::HairStyle::kFringe : faces::HairStyle::kShort;
  }
  if (hair.forehead < kFringeBelow) looks.hair_fringe = 0.8;
  return looks;
}

}  // namespace daumier::portrait
