#include "faces/appearance/skin_tone.h"

#include "core/error.h"
#include "faces/appearance/albedo_modes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace daumier::faces {
namespace {

/// Lightness between neighbouring tones.
constexpr std::array<double, kNumSkinTones - 1> kToneBorders = {78, 69, 58, 46, 35};

double LinearLightOf(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

Eigen::Vector3f SkinColour(float melanin, float haemoglobin, float warmth) {
  return (kMeanSkin + melanin * kMelaninStep + haemoglobin * kHaemoglobinStep + warmth * kWarmthStep)
      .cwiseMax(0.0f)
      .cwiseMin(1.0f);
}

double Lightness(const Eigen::Vector3f& colour) {
  const double y =
      0.2126 * LinearLightOf(colour[0]) + 0.7152 * LinearLightOf(colour[1]) + 0.0722 * LinearLightOf(colour[2]);
  return y > 216.0 / 24389 ? 116 * std::cbrt(y) - 16 : y * 24389 / 27;
}

int SkinToneOf(const Eigen::VectorXf& a) {
  DAUMIER_CHECK(a.size() >= 3, "a skin tone of {} albedo coefficients, expected 3 or more", a.size());
  const double lightness = Lightness(SkinColour(a[0], a[1], a[2]));
  return static_cast<int>(
      std::count_if(kToneBorders.begin(), kToneBorders.end(), [&](double border) { return lightness < border; }));
}

float MelaninOfTone(int tone) {
  DAUMIER_CHECK(0 <= tone && tone < kNumSkinTones, "skin tone {}, expected 0 to 5", tone);
  constexpr std::array<double, kNumSkinTones> kMiddles = {82, 73.5, 63.5, 52, 40.5, 28};
  double low = -4, high = 4;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (Lightness(SkinColour(float(middle), 0, 0)) > kMiddles[size_t(tone)] ? low : high) = middle;
  }
  return float(low);
}

}  // namespace daumier::faces
