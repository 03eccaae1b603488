#pragma once
#include "faces/face_model.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace daumier::faces {

/// A linear model of the colours of a face's skin. Colours are display values, RGB in [0, 1]:
///   albedo = mean + sum_k a_k mode_k,  a ~ N(0, 1) independently; clamped to [0, 1] only where colours are used.
struct AlbedoBasis {
  Eigen::MatrixXf mean;            ///< V x 3.
  Eigen::MatrixXf modes;           ///< 3V x K, unit sigma; channels of a vertex next to each other (r0 g0 b0 r1 ...).
  std::vector<std::string> names;  ///< K, unique.

  // A mode is a field times a colour: mode_k of vertex v = fields(v, field_of[k]) steps.col(k). Few fields serve all modes.
  Eigen::MatrixXf fields;     ///< V x M; empty in a basis from elsewhere.
  std::vector<int> field_of;  ///< K.
  Eigen::MatrixXf steps;      ///< 3 x K.
};

/// 40 named modes, then 20 lightness and 20 redness bands.
inline constexpr int kNumAlbedoModes = 80, kNumNamedAlbedoModes = 40, kNumAlbedoBands = 20;

/// Our own basis for any annotated template. Modes 0 to 39 are products of a colour and a soft region (SkinFields):
/// whole skin, lips, brows, lids, blush, beard shadow, age. Modes 40 to 79 are bands: the 20 smoothest functions of the
/// surface but for the constant (geometry::SmoothestFunctions), root mean square 1 over the area, times a grey and times a
/// reddish step that fall with the band.
/// Promises: the named modes are symmetric where the template is; the same template gives the same basis.
/// @throws Error as SkinFields and SmoothestFunctions.
AlbedoBasis MakeAlbedoBasis(const FaceTemplate& face_template);

/// Index of a mode by its name: "melanin", "lips_red", "lightness_band_3". @throws Error if there is none of that name.
int AlbedoMode(const std::string& name);

/// V x 3 in [0, 1]. @throws Error unless there are K coefficients.
Eigen::MatrixXf AlbedoOf(const AlbedoBasis& basis, const Eigen::VectorXf& coefficients);

}  // namespace daumier::faces
