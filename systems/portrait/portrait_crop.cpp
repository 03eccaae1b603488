#include "systems/portrait/portrait_crop.h"

#include "core/error.h"
#include "render/draw.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::portrait {

PictureMap PictureMap::Inverse() const {
  const Eigen::Matrix2d inverse = linear.inverse();
  return {inverse, -inverse * shift};
}

PictureMap Compose(const PictureMap& second, const PictureMap& first) {
  return {second.linear * first.linear, second.linear * first.shift + second.shift};
}

PictureMap CropOfLandmarks(std::span<const float> landmarks, double size) {
  constexpr double kBelowMiddle = 0.05;
  DAUMIER_CHECK(landmarks.size() == 136, "{} numbers of landmarks, expected 136", landmarks.size());
  Eigen::Vector2d low(landmarks[0], landmarks[1]), high = low;
  for (size_t n = 0; n < 68; ++n) {
    const Eigen::Vector2d p(landmarks[2 * n], landmarks[2 * n + 1]);
    DAUMIER_CHECK(p.allFinite(), "landmark {} is not finite", n);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double side = (high - low).maxCoeff();
  DAUMIER_CHECK(side > 0, "all landmarks are in one point");
  const double scale = size * kPortraitSide / side;
  const Eigen::Vector2d place(0.5 * kPortraitSide, (0.5 + kBelowMiddle) * kPortraitSide);
  return {scale * Eigen::Matrix2d::Identity(), place - scale * (low + high) / 2};
}

PictureMap CropOfWhole(int height, int width) {
  DAUMIER_CHECK(height > 0 && width > 0, "a picture of {} x {} has no crop", height, width);
  const double scale = double(kPortraitSide) / std::max(height, width);
  return {scale * Eigen::Matrix2d::Identity(),
          0.5 * (Eigen::Vector2d::Constant(kPortraitSide) - scale * Eigen::Vector2d(width, height))};
}

PictureMap DrawJitter(const PortraitPictureOptions& options, Rng& rng) {
  const double angle = options.rotation * rng.Uniform(-1, 1) * std::numbers::pi / 180,
               scale = 1 + options.scale * rng.Uniform(-1, 1);
  const Eigen::Vector2d shift(options.shift * rng.Uniform(-1, 1), options.shift * rng.Uniform(-1, 1));
  PictureMap map;
  map.linear << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  map.linear *= scale;
  const Eigen::Vector2d centre = Eigen::Vector2d::Constant(kPortraitSide / 2.0);
  map.shift = centre - map.linear * centre + shift;
  return map;
}

void SamplePixel(const render::Image& picture, const Eigen::Vector2d& point, Sampling sampling, uint8_t* out) {
  const int channels = picture.channels;
  if (sampling == Sampling::kNearest) {
    const int x = int(std::clamp(std::floor(point.x()), 0.0, picture.width - 1.0)),
              y = int(std::clamp(std::floor(point.y()), 0.0, picture.height - 1.0));
    for (int c = 0; c < channels; ++c) out[c] = picture.at(y, x, c);
    return;
  }
  const double x = std::clamp(point.x() - 0.5, 0.0, picture.width - 1.0),
               y = std::clamp(point.y() - 0.5, 0.0, picture.height - 1.0);
  const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, picture.width - 1),
            y1 = std::min(y0 + 1, picture.height - 1);
  const float fx = float(x - x0), fy = float(y - y0);
  for (int c = 0; c < channels; ++c) {
    const float top = float(picture.at(y0, x0, c)) * (1 - fx) + float(picture.at(y0, x1, c)) * fx,
                bottom = float(picture.at(y1, x0, c)) * (1 - fx) + float(picture.at(y1, x1, c)) * fx;
    out[c] = uint8_t(top * (1 - fy) + bottom * fy + 0.5F);
  }
}

render::Image WarpPicture(const render::Image& picture, const PictureMap& map, Sampling sampling) {
  DAUMIER_CHECK(!picture.pixels.empty(), "an empty picture is cropped");
  const double scale = map.scale();
  constexpr double kLeastScale = 0.67;
  const bool is_pixel = picture.height == 1 && picture.width == 1;
  if (sampling == Sampling::kBilinear && scale < kLeastScale && !is_pixel) {
    const int height = std::max(1, int(std::lround(picture.height * scale))),
              width = std::max(1, int(std::lround(picture.width * scale)));
    PictureMap rest = map;
    rest.linear.col(0) *= double(picture.width) / width;
    rest.linear.col(1) *= double(picture.height) / height;
    return WarpPicture(render::Resize(picture, height, width), rest, sampling);
  }
  const PictureMap back = map.Inverse();
  render::Image crop(kPortraitSide, kPortraitSide, picture.channels);
  uint8_t* out = crop.pixels.data();
  for (int row = 0; row < kPortraitSide; ++row)
    for (int column = 0; column < kPortraitSide; ++column, out += picture.channels)
      SamplePixel(picture, back({column + 0.5, row + 0.5}), sampling, out);
  return crop;
}

std::vector<float> MapLandmarks(std::span<const float> landmarks, const PictureMap& map) {
  std::vector<float> mapped(landmarks.size());
  for (size_t n = 0; n + 1 < landmarks.size(); n += 2) {
    const Eigen::Vector2d p = map({landmarks[n], landmarks[n + 1]});
    mapped[n] = float(p.x());
    mapped[n + 1] = float(p.y());
  }
  return mapped;
}

std::vector<float> ColourPlanes(const render::Image& picture) {
  const render::Image rgb = picture.channels == 3 ? picture : render::ToRgb(picture);
  const size_t num_pixels = size_t(rgb.height) * size_t(rgb.width);
  std::vector<float> planes(3 * num_pixels);
  for (size_t i = 0; i < num_pixels; ++i)
    for (size_t c = 0; c < 3; ++c) planes[c * num_pixels + i] = float(rgb.pixels[3 * i + c]) * (1.0F / 255);
  return planes;
}

std::vector<float> NetworkPicture(const render::Image& crop, int resolution) {
  return ColourPlanes(
      crop.height == resolution && crop.width == resolution ? crop : render::Resize(crop, resolution, resolution));
}

}  // namespace daumier::portrait
