#pragma once
#include <Eigen/Core>

namespace daumier::faces {

inline constexpr int kNumSkinTones = 6;

/// Colour of bare skin for the first three albedo coefficients (melanin, haemoglobin, warmth), display RGB in [0, 1]:
///   mean + sum_k a_k step_k, clamped.
Eigen::Vector3f SkinColour(float melanin, float haemoglobin, float warmth);

/// CIE lightness L* in [0, 100] of a display colour [IEC 61966-2-1].
double Lightness(const Eigen::Vector3f& colour);

/// 0 (very light) to 5 (very dark), by the lightness of SkinColour of the first three coefficients: the six tones of
/// Fitzpatrick-like scales. Never rises with lightness. @throws Error with less than three coefficients.
int SkinToneOf(const Eigen::VectorXf& albedo_coefficients);

/// A melanin coefficient in the middle of a tone. @throws Error unless tone is 0 to 5.
float MelaninOfTone(int tone);

}  // namespace daumier::faces
