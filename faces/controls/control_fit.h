#pragma once
#include "faces/controls/face_controls.h"

#include <vector>

namespace daumier::faces {

/// Measures faces in values of controls: the z that minimises
///   sum_v |(face - mean)_v - (J z)_v|^2 + ridge trace(J^T J) / K |z|^2
/// over the vertices v of the annotation's region `face`, J the controls' Jacobian, K the number of values.
/// Promises: a face that differs from the mean by J z has values z up to the ridge; the mean face has values of 0.
class ControlFit {
 public:
  /// `population`: neutral faces, V x 3 cm; their mean is the mean face, and the root mean square of their values the
  /// deviations. @throws Error if there are fewer than kFewestFaces, or of another number of vertices.
  ControlFit(const FaceControls& controls, const FaceTemplate& face_template,
             const std::vector<geometry::Points>& population);

  /// num_values: those of a face.
  Eigen::VectorXd ValuesOf(const geometry::Points& face) const;
  /// num_values: root mean square over the population; left and right of a pair share theirs.
  const Eigen::VectorXd& deviations() const { return deviations_; }
  const geometry::Points& mean() const { return mean_; }

  static constexpr int kFewestFaces = 8;

 private:
  std::vector<int> region_;
  geometry::Points mean_;
  Eigen::MatrixXf solver_;  ///< K x 3R: (J^T J + ridge)^-1 J^T.
  Eigen::VectorXd deviations_;
};

}  // namespace daumier::faces
