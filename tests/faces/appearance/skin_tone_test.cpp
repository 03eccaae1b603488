#include "faces/appearance/skin_tone.h"

#include "faces/appearance/albedo_basis.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace daumier::faces {
namespace {

TEST(SkinTone, NeverRisesWithLightnessAndAllSixExist) {
  std::set<int> tones;
  double before = 1000;
  int tone_before = 0;
  for (float melanin = -2; melanin <= 3; melanin += 0.05f) {
    Eigen::VectorXf a = Eigen::VectorXf::Zero(kNumAlbedoModes);
    a[0] = melanin;
    const double lightness = Lightness(SkinColour(melanin, 0, 0));
    const int tone = SkinToneOf(a);
    EXPECT_LE(lightness, before);
    EXPECT_GE(tone, tone_before);
    before = lightness, tone_before = tone;
    tones.insert(tone);
  }
  EXPECT_EQ(tones.size(), size_t(kNumSkinTones));
  for (int tone = 0; tone < kNumSkinTones; ++tone) {
    Eigen::VectorXf a = Eigen::VectorXf::Zero(3);
    a[0] = MelaninOfTone(tone);
    EXPECT_EQ(SkinToneOf(a), tone);
    EXPECT_LT(std::abs(a[0]), 2.5) << "within the prior";
  }
  EXPECT_NEAR(Lightness({1, 1, 1}), 100, 1e-6);
  EXPECT_EQ(Lightness({0, 0, 0}), 0);
  EXPECT_NEAR(Lightness({0.466f, 0.466f, 0.466f}), 50, 0.1);
  testing::ExpectError([] { MelaninOfTone(6); }, "skin tone 6");
  testing::ExpectError([] { SkinToneOf(Eigen::VectorXf::Zero(2)); }, "expected 3");
}

}  // namespace
}  // namespace daumier::faces
