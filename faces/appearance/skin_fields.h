#pragma once
#include "faces/face_model.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::faces {

/// The middle line of a brow on the neutral template from its inner to its outer end, with half its height, cm.
struct BrowLine {
  std::vector<geometry::Vector3> centre;  ///< kBrowPoints.
  std::vector<double> half_height;
};
inline constexpr int kBrowPoints = 9;

/// Of the right and the left brow. Where the annotation has closed curves of the kind `brow` in the frontal view, the
/// middle between their upper and lower sides; otherwise the line of landmarks 17 to 21 and 22 to 26, 0.03 eye spans high.
std::vector<BrowLine> FindBrowLines(const FaceTemplate& face_template);

/// V: 1 at the lips and their border, 0 elsewhere: what is reached from the mouth's hole without crossing the closed
/// curve of kind `lips`; without such a curve or hole, what lies in front within the landmarks 48 to 59.
Eigen::VectorXd LipIndicator(const FaceTemplate& face_template);

/// A weight in [0, 1] for each vertex, V, of a region of skin that has colours of its own: "skin", "lips", "brows",
/// "cheeks", "beard", ... (albedo_modes.cpp uses them). Symmetric where the template is. @throws Error on another name.
Eigen::VectorXd SkinField(const FaceTemplate& face_template, const std::string& name);

}  // namespace daumier::faces
