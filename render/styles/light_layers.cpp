#include "render/styles/light_layers.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr float kOcclusionReach = 6;     ///< Units.
constexpr float kOcclusionDepth = 1.5f;  ///< Cm.
constexpr float kShadowReach = 7;        ///< Cm.
constexpr float kShadowBias = 0.3f;      ///< Cm.
constexpr float kShadowThickness = 6;    ///< Cm.
constexpr int kShadowSteps = 12;

bool IsSkinPixel(const PictureLayers& layers, size_t pixel) {
  return layers.classes[pixel] == static_cast<uint8_t>(PictureClass::kSkin);
}

/// Values of covered pixels over their blurred coverage; `otherwise` where that is none.
Plane MaskedBlur(const Plane& plane, const Plane& coverage, float deviation, float otherwise) {
  Plane product(plane.height, plane.width);
  for (size_t i = 0; i < product.values.size(); ++i) product.values[i] = plane.values[i] * coverage.values[i];
  product = Blur(product, deviation);
  const Plane weight = Blur(coverage, deviation);
  for (size_t i = 0; i < product.values.size(); ++i) {
    product.values[i] = weight.values[i] > 1e-3f ? product.values[i] / weight.values[i] : otherwise;
  }
  return product;
}

}  // namespace

std::array<float, 3> MainLight(const PictureLayers& layers) {
  constexpr std::array<float, 3> kUsual = {-0.501f, 0.602f, 0.622f};
  Eigen::Matrix4d products = Eigen::Matrix4d::Zero();
  Eigen::Vector4d sums = Eigen::Vector4d::Zero();
  for (size_t i = 0; i < layers.size(); i += 3) {
    if (layers.coverage.values[i] == 0) continue;
    const Eigen::Vector4d row(1, layers.normal[0].values[i], layers.normal[1].values[i], layers.normal[2].values[i]);
    products += row * row.transpose();
    sums += row * double(layers.shade.values[i]);
  }
  if (products(0, 0) < 16) return kUsual;
  products.diagonal().array() += 1e-3 * products(0, 0);
  const Eigen::Vector4d fit = products.ldlt().solve(sums);
  Eigen::Vector3d light = fit.tail<3>();
  if (!light.allFinite() || light.norm() < 0.02) return kUsual;
  light.normalize();
  light.z() = std::max(light.z(), 0.2);
  light.normalize();
  return {static_cast<float>(light.x()), static_cast<float>(light.y()), static_cast<float>(light.z())};
}

ShadeRange RangeOfShade(const PictureLayers& layers) {
  std::vector<float> shades;
  for (const bool skin_only : {true, false}) {
    shades.clear();
    for (size_t i = 0; i < layers.size(); ++i) {
      if (layers.coverage.values[i] > 0.99f && (!skin_only || IsSkinPixel(layers, i))) {
        shades.push_back(layers.shade.values[i]);
      }
    }
    if (shades.size() >= 30) break;
  }
  if (shades.empty()) return {};
  const auto percentile = [&](double share) {
    const auto place = shades.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(shades.size() - 1));
    std::nth_element(shades.begin(), place, shades.end());
    return *place;
  };
  return {percentile(0.05), percentile(0.95)};
}

Plane Occlusion(const PictureLayers& layers) {
  const Plane mean = MaskedBlur(layers.depth, layers.coverage, kOcclusionReach * layers.scale, 0.0f);
  Plane occlusion(layers.height, layers.width);
  for (size_t i = 0; i < occlusion.values.size(); ++i) {
    if (layers.coverage.values[i] == 0) continue;
    const float behind = (layers.depth.values[i] - mean.values[i]) * (1.0f / kOcclusionDepth);
    // At silhouettes the surroundings are nearer only because nothing is covered beyond.
    const float facing = std::clamp(2.0f * layers.normal[2].values[i], 0.0f, 1.0f);
    occlusion.values[i] = std::clamp(behind, 0.0f, 1.0f) * facing;
  }
  return occlusion;
}

Plane CastShadows(const PictureLayers& layers, const std::array<float, 3>& light) {
  const int height = layers.height, width = layers.width;
  Plane shadow(height, width);
  for (int step = 1; step <= kShadowSteps; ++step) {
    const float distance = kShadowReach * static_cast<float>(step) / kShadowSteps;
    const int across = static_cast<int>(std::lround(light[0] * distance * layers.pixels_per_cm));
    const int down = static_cast<int>(std::lround(-light[1] * distance * layers.pixels_per_cm));
    if (across == 0 && down == 0) continue;
    const float nearest = light[2] * distance + kShadowBias, farthest = nearest + kShadowThickness;
    const int from = std::max(0, -across), to = std::min(width, width - across);
    for (int row = std::max(0, -down); row < std::min(height, height - down); ++row) {
      const float* here = layers.depth.row(row);
      const float* there = layers.depth.row(row + down) + across;
      float* target = shadow.row(row);
      for (int column = from; column < to; ++column) {
        const float gap = here[column] - there[column];
        target[column] = std::max(target[column], gap > nearest && gap < farthest ? 1.0f : 0.0f);
      }
    }
  }
  for (size_t i = 0; i < shadow.values.size(); ++i) {
    if (layers.coverage.values[i] == 0) shadow.values[i] = 0;
  }
  return MaskedBlur(shadow, layers.coverage, layers.scale, 0.0f);
}

Plane SmoothShade(const PictureLayers& layers, float deviation) {
  return MaskedBlur(layers.shade, layers.coverage, deviation * layers.scale, 0.0f);
}

}  // namespace daumier::render
