#pragma once
#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::faces {

/// The named modes of AlbedoBasis: a colour step, RGB for one unit, times a field of SkinField.
struct AlbedoModeSpec {
  std::string name, field;
  Eigen::Vector3f step;
};

/// 40, in the order of the coefficients. docs/albedo.md shows them.
const std::vector<AlbedoModeSpec>& NamedAlbedoModes();

/// What the mean differs from plain skin by: lips, cheeks, lids and so on.
const std::vector<AlbedoModeSpec>& MeanAlbedoParts();

/// Plain skin, and its steps for melanin (positive is darker), haemoglobin and warmth.
inline const Eigen::Vector3f kMeanSkin{0.74f, 0.56f, 0.455f};
inline const Eigen::Vector3f kMelaninStep{-0.170f, -0.156f, -0.136f};
inline const Eigen::Vector3f kHaemoglobinStep{0.014f, -0.014f, -0.009f};
inline const Eigen::Vector3f kWarmthStep{0.010f, 0.002f, -0.022f};

}  // namespace daumier::faces
