#include "fitting/texture_iris.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::fitting {
namespace {

constexpr size_t kLeastPixels = 20;
/// Of an eye, radii of its ball.
constexpr double kReach = 1.1;

struct EyePixel {
  float x, y, lightness;
};

float LightnessAt(const PictureLayer& layer, size_t pixel) {
  const float* const c = layer.colours.data() + 3 * pixel;
  return 0.299F * c[0] + 0.587F * c[1] + 0.114F * c[2];
}

std::vector<EyePixel> PixelsOfEye(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach) {
  std::vector<EyePixel> pixels;
  const int top = std::max(0, int(middle.y() - reach)), bottom = std::min(eyes.height - 1, int(middle.y() + reach));
  const int left = std::max(0, int(middle.x() - reach)), right = std::min(eyes.width - 1, int(middle.x() + reach));
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const size_t pixel = size_t(row) * size_t(eyes.width) + size_t(column);
      const float x = float(column) + 0.5F, y = float(row) + 0.5F;
      if (eyes.confidence[pixel] <= 0 || std::hypot(x - middle.x(), y - middle.y()) > reach) continue;
      pixels.push_back({x, y, LightnessAt(eyes, pixel)});
    }
  }
  return pixels;
}

float MedianOfRing(std::vector<float>& values) {
  const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::optional<IrisDisc> FindIris(const PictureLayer& eyes, const Eigen::Vector2d& middle, double ball_radius,
                                 const IrisSizes& sizes) {
  constexpr size_t kMostPixels = 700;
  constexpr double kLeastContrast = 0.06, kSpread = 0.35;
  constexpr int kNumRadii = 12;
  std::vector<EyePixel> pixels = PixelsOfEye(eyes, middle, kReach * ball_radius);
  if (pixels.size() < kLeastPixels) return std::nullopt;
  float left = pixels[0].x, right = left, top = pixels[0].y, bottom = top;
  for (const EyePixel& p : pixels) {
    left = std::min(left, p.x), right = std::max(right, p.x), top = std::min(top, p.y), bottom = std::max(bottom, p.y);
  }
  const double step = std::max(1.0, (right - left + 1) / 28.0);
  if (const size_t stride = pixels.size() / kMostPixels + 1; stride > 1) {
    std::vector<EyePixel> some;
    for (size_t i = 0; i < pixels.size(); i += stride) some.push_back(pixels[i]);
    pixels = std::move(some);
  }
  double total = 0;
  for (const EyePixel& p : pixels) total += p.lightness;
  const auto count = double(pixels.size());
  std::array<double, kNumRadii> radii{}, priors{};
  for (int k = 0; k < kNumRadii; ++k) {
    const double share = sizes.least + (sizes.most - sizes.least) * k / (kNumRadii - 1);
    radii[size_t(k)] = ball_radius * share;
    priors[size_t(k)] = std::exp(-0.5 * std::pow(std::log(share / sizes.usual) / kSpread, 2));
  }

  std::optional<IrisDisc> best;
  double contrast = 0;
  std::array<double, kNumRadii> sums{}, counts{};
  for (double y = top; y <= bottom; y += step) {
    for (double x = left; x <= right; x += step) {
      sums.fill(0), counts.fill(0);
      for (const EyePixel& p : pixels) {
        // The least radius that holds the pixel.
        const auto k = size_t(std::ranges::lower_bound(radii, std::hypot(p.x - x, p.y - y)) - radii.begin());
        if (k < radii.size()) sums[k] += p.lightness, ++counts[k];
      }
      double inside = 0, num_inside = 0;
      for (size_t k = 0; k < radii.size(); ++k) {
        inside += sums[k], num_inside += counts[k];
        if (num_inside < 4 || count - num_inside < 4) continue;
        const double difference = (total - inside) / (count - num_inside) - inside / num_inside;
        const double score = priors[k] * num_inside * (count - num_inside) / (count * count) * difference * difference;
        if (difference <= 0 || (best && score <= best->score)) continue;
        contrast = difference;
        best = IrisDisc{{x, y}, radii[k], score};
      }
    }
  }
  return contrast < kLeastContrast ? std::nullopt : best;
}

IrisProfile::IrisProfile(const PictureLayer& eyes, const IrisDisc& iris) {
  std::array<std::array<std::vector<float>, 3>, kNumRings> rings;
  for (const EyePixel& pixel : PixelsOfEye(eyes, iris.centre, iris.radius)) {
    const double share = std::hypot(pixel.x - iris.centre.x(), pixel.y - iris.centre.y()) / iris.radius;
    const size_t ring = std::min(kNumRings - 1, size_t(share * kNumRings));
    const size_t from = 3 * (size_t(pixel.y) * size_t(eyes.width) + size_t(pixel.x));
    for (size_t k = 0; k < 3; ++k) rings[ring][k].push_back(eyes.colours[from + k]);
  }
  for (size_t ring = 0; ring < kNumRings; ++ring) {
    colours_[ring].setZero();
    for (size_t away = 0; away < kNumRings; ++away) {
      const bool has_inner = ring >= away && !rings[ring - away][0].empty(),
                 has_outer = ring + away < kNumRings && !rings[ring + away][0].empty();
      if (!has_inner && !has_outer) continue;
      auto& nearest = rings[has_inner ? ring - away : ring + away];
      for (size_t k = 0; k < 3; ++k) colours_[ring][Eigen::Index(k)] = MedianOfRing(nearest[k]);
      break;
    }
  }
  Smooth();
  Smooth();
}

void IrisProfile::Smooth() {
  const auto before = colours_;
  for (size_t ring = 0; ring < kNumRings; ++ring)
    colours_[ring] = 0.25F * before[ring == 0 ? 0 : ring - 1] + 0.5F * before[ring] +
                     0.25F * before[std::min(ring + 1, kNumRings - 1)];
}

Eigen::Vector3f IrisProfile::At(float share) const {
  const float place = std::clamp(share * kNumRings - 0.5F, 0.0F, float(kNumRings - 1));
  const auto first = std::min(size_t(place), kNumRings - 2);
  const float t = place - float(first);
  return (1 - t) * colours_[first] + t * colours_[first + 1];
}

std::optional<Eigen::Vector3f> MedianOfEye(const PictureLayer& eyes, const Eigen::Vector2d& middle,
                                           double ball_radius) {
  std::array<std::vector<float>, 3> values;
  for (const EyePixel& pixel : PixelsOfEye(eyes, middle, kReach * ball_radius)) {
    const size_t from = 3 * (size_t(pixel.y) * size_t(eyes.width) + size_t(pixel.x));
    for (size_t k = 0; k < 3; ++k) values[k].push_back(eyes.colours[from + k]);
  }
  if (values[0].size() < kLeastPixels) return std::nullopt;
  return Eigen::Vector3f(MedianOfRing(values[0]), MedianOfRing(values[1]), MedianOfRing(values[2]));
}

std::optional<float> WhiteLightness(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach,
                                    const std::optional<IrisDisc>& iris) {
  constexpr size_t kLeastWhites = 10;
  std::vector<float> values;
  for (const EyePixel& p : PixelsOfEye(eyes, middle, reach))
    if (!iris || std::hypot(p.x - iris->centre.x(), p.y - iris->centre.y()) > iris->radius)
      values.push_back(p.lightness);
  if (values.size() < kLeastWhites) return std::nullopt;
  const auto bright = values.begin() + ptrdiff_t(values.size() * 9 / 10);
  std::nth_element(values.begin(), bright, values.end());
  return *bright;
}

}  // namespace daumier::fitting
