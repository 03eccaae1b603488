#include "raster/spherical_harmonics.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

using Light = std::array<double, kLightBands>;

double ShadeOf(const Light& light, const std::array<double, 3>& normal) {
  double shade = 0;
  Shade(light, 1, normal.data(), &shade);
  return shade;
}

TEST(Shade, OfNoLightIsTheAmbientOne) {
  EXPECT_NEAR(ShadeOf({}, {0, 0, 1}), 0.709, 1e-3);
}

TEST(Shade, EachBandIsThePrintedFunctionOfTheNormal) {
  const double x = 0.36, y = -0.48, z = 0.8;
  const Light expected = {0.886227,
                          -1.772454 * y,
                          1.772454 * z,
                          -1.772454 * x,
                          2.427032 * x * y,
                          -2.427032 * y * z,
                          0.700624 * (3 * z * z - 1),
                          -2.427032 * x * z,
                          1.213516 * (x * x - y * y)};
  for (int k = 0; k < kLightBands; ++k) {
    Light light = {};
    light[k] = 1;
    EXPECT_NEAR(ShadeOf(light, {x, y, z}) - ShadeOf({}, {x, y, z}), expected[k], 1e-12) << k;
  }
}

TEST(Shade, GradientsEqualCentralDifferences) {
  const auto light = RandomNumbers<double>(kLightBands, 1), normals = RandomNumbers<double>(21, 2);
  const auto weights = RandomNumbers<double>(7, 3);
  const auto sum = [&](const std::vector<double>& of, const std::vector<double>& at) {
    Light given;
    std::copy_n(of.begin(), kLightBands, given.begin());
    std::vector<double> shades(7);
    Shade(given, 7, at.data(), shades.data());
    return Dot(weights, shades);
  };
  Light given, by_light = {};
  std::copy_n(light.begin(), kLightBands, given.begin());
  std::vector<double> by_normals(21);
  ShadeBackward(given, 7, normals.data(), weights.data(), by_light, by_normals.data());
  EXPECT_LT(MaxDifference([&](const auto& x) { return sum(x, normals); }, light, {by_light.begin(), by_light.end()}),
            1e-8);
  EXPECT_LT(MaxDifference([&](const auto& x) { return sum(light, x); }, normals, by_normals), 1e-8);
}

}  // namespace
}  // namespace daumier::raster
