#include "datasets/build/portrait_light.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(PortraitLight, EvenLightIsTheSameOnAllSides) {
  SphericalLight light{};
  EXPECT_NEAR(LightOn(light, Eigen::Vector3f::UnitZ()), 0.8 * 0.886227, 1e-6);
  light = ProjectLight(0.5, {});
  for (const auto& normal : {Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitZ()})
    EXPECT_NEAR(LightOn(light, normal), 0.5, 1e-6);
}

TEST(PortraitLight, HarmonicsHaveThePublishedConstants) {
  const Eigen::Vector3f n = Eigen::Vector3f(0.36f, 0.48f, 0.8f);
  const double expected[9] = {0.886227,
                              -1.772454 * 0.48,
                              1.772454 * 0.8,
                              -1.772454 * 0.36,
                              2.427032 * 0.36 * 0.48,
                              -2.427032 * 0.48 * 0.8,
                              0.700624 * (3 * 0.64 - 1),
                              -2.427032 * 0.36 * 0.8,
                              1.213516 * (0.36 * 0.36 - 0.48 * 0.48)};
  for (size_t k = 0; k < 9; ++k) {
    SphericalLight light{};
    const float before = LightOn(light, n);
    light[k] = 1;
    EXPECT_NEAR(LightOn(light, n) - before, expected[k], 1e-6) << k;
  }
}

TEST(PortraitLight, ALampIsTheClampedCosineUpToItsSecondDegree) {
  Rng rng(4);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d d = Eigen::Vector3d(rng.Normal(), rng.Normal(), rng.Normal()).normalized();
    const Eigen::Vector3d n = Eigen::Vector3d(rng.Normal(), rng.Normal(), rng.Normal()).normalized();
    const double c = n.dot(d), series = 0.25 + 0.5 * c + 5.0 / 32 * (3 * c * c - 1);
    const float lit = LightOn(ProjectLight(0.2, {{d, 0.6}}), n.cast<float>());
    EXPECT_NEAR(lit, 0.2 + 0.6 * series, 1e-5);
    EXPECT_NEAR(lit, 0.2 + 0.6 * std::max(0.0, c), 0.06);
  }
}

TEST(PortraitLight, FacesThatLookAtTheViewerAreNeitherDarkNorBurnt) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const float front = LightOn(DrawLight(rng), Eigen::Vector3f::UnitZ());
    EXPECT_GE(front, 0.72f - 1e-5f);
    EXPECT_LE(front, 1.08f + 1e-5f);
  }
}

}  // namespace
}  // namespace daumier::datasets
