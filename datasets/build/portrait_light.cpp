#include "datasets/build/portrait_light.h"

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

constexpr float kAmbientOffset = 0.8f;
// Degree 0, degree 1, products of degree 2, 3 z^2 - 1, x^2 - y^2.
constexpr double kH0 = 0.886227, kH1 = 1.772454, kH2 = 2.427032, kH20 = 0.700624, kH22 = 1.213516;

Eigen::Vector3d Direction(double azimuth_degrees, double elevation_degrees) {
  const double a = azimuth_degrees * std::numbers::pi / 180, e = elevation_degrees * std::numbers::pi / 180;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

}  // namespace

float LightOn(const SphericalLight& light, const Eigen::Vector3f& normal) {
  const float x = normal.x(), y = normal.y(), z = normal.z();
  return (light[0] + kAmbientOffset) * float(kH0) + float(kH1) * (-light[1] * y + light[2] * z - light[3] * x) +
         float(kH2) * (light[4] * x * y - light[5] * y * z - light[7] * x * z) +
         float(kH20) * light[6] * (3 * z * z - 1) + float(kH22) * light[8] * (x * x - y * y);
}

SphericalLight ProjectLight(double ambient, const std::vector<DirectionalLight>& lamps) {
  // max(0, c) = 1/4 + c/2 + 5/16 (3 c^2 - 1)/2 + ..., c = n . d; the last as products of coordinates of n and of d.
  std::array<double, 9> sums = {ambient};
  for (const DirectionalLight& lamp : lamps) {
    const double x = lamp.direction.x(), y = lamp.direction.y(), z = lamp.direction.z(), s = lamp.strength;
    const double second = 5.0 / 16 * s;
    sums[0] += s / 4;
    sums[1] += s / 2 * y;
    sums[2] += s / 2 * z;
    sums[3] += s / 2 * x;
    sums[4] += second * 3 * x * y;
    sums[5] += second * 3 * y * z;
    sums[6] += second / 4 * (3 * z * z - 1);
    sums[7] += second * 3 * x * z;
    sums[8] += second * 3 / 4 * (x * x - y * y);
  }
  const std::array<double, 9> scale = {kH0, -kH1, kH1, -kH1, kH2, -kH2, kH20, -kH2, kH22};
  SphericalLight light;
  for (size_t k = 0; k < light.size(); ++k) light[k] = static_cast<float>(sums[k] / scale[k]);
  light[0] -= kAmbientOffset;
  return light;
}

SphericalLight DrawLight(Rng& rng) {
  const double ambient = rng.Uniform(0.3, 0.7);
  std::vector<DirectionalLight> lamps;
  const double key_azimuth = rng.Uniform(-75, 75);
  lamps.push_back({Direction(key_azimuth, rng.Uniform(-10, 65)), rng.Uniform(0.25, 0.9)});
  if (rng.Uniform() < 0.5)
    lamps.push_back({Direction(-key_azimuth + rng.Uniform(-30, 30), rng.Uniform(-20, 40)), rng.Uniform(0.1, 0.35)});
  if (rng.Uniform() < 0.35) {
    const double side = rng.Uniform() < 0.5 ? -1 : 1;
    lamps.push_back({Direction(side * rng.Uniform(110, 160), rng.Uniform(0, 50)), rng.Uniform(0.2, 0.6)});
  }
  const double in_front = LightOn(ProjectLight(ambient, lamps), Eigen::Vector3f::UnitZ());
  const double factor = rng.Uniform(0.72, 1.08) / in_front;
  for (DirectionalLight& lamp : lamps) lamp.strength *= factor;
  return ProjectLight(ambient * factor, lamps);
}

}  // namespace daumier::datasets
