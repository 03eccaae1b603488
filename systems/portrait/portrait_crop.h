#pragma once
#include "core/random.h"
#include "render/image.h"
#include "systems/portrait/portrait_options.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <span>
#include <vector>

namespace daumier::portrait {

/// Side of a crop, pixels: what the camera of portraits sees.
inline constexpr int kPortraitSide = 224;

/// A similarity of pictures: p_crop = linear * p_picture + shift, pixels.
struct PictureMap {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const { return linear * p + shift; }
  PictureMap Inverse() const;
  double scale() const { return std::sqrt(linear.determinant()); }
  /// Clockwise in the picture, whose y points down: radians.
  double rotation() const { return std::atan2(linear(1, 0), linear(0, 0)); }
};

/// first, then second.
PictureMap Compose(const PictureMap& second, const PictureMap& first);

/// The crop in which the box of the landmarks (68 x 2: x0 y0 ...) has the longer side size * 224 and its centre a little
/// below the middle, at (0.5, 0.55). @throws Error if all landmarks are in one point or one is not finite.
PictureMap CropOfLandmarks(std::span<const float> landmarks, double size);
/// A picture of any size as a whole: centred, its longer side 224.
PictureMap CropOfWhole(int height, int width);

/// A random rotation and scale about the crop's centre, then a shift.
PictureMap DrawJitter(const PortraitPictureOptions& options, Rng& rng);

enum class Sampling { kBilinear, kNearest };
/// The channels of a picture at a point, pixels; beyond the picture its border is repeated.
void SamplePixel(const render::Image& picture, const Eigen::Vector2d& point, Sampling sampling, uint8_t* out);
/// The 224 x 224 picture whose pixel centres p show map^-1(p); what is outside of the picture repeats its border. Where
/// the map makes a picture smaller, it is resized first, so that nothing is aliased. Same number of channels.
render::Image WarpPicture(const render::Image& picture, const PictureMap& map, Sampling sampling = Sampling::kBilinear);

/// Landmarks (68 x 2) under the map.
std::vector<float> MapLandmarks(std::span<const float> landmarks, const PictureMap& map);

/// What a network of that resolution reads of a crop, 3 x R x R colours 0 .. 1 (render::Resize).
std::vector<float> NetworkPicture(const render::Image& crop, int resolution);
/// 3 x H x W colours 0 .. 1 of an RGB picture.
std::vector<float> ColourPlanes(const render::Image& picture);

}  // namespace daumier::portrait
