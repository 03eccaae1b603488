#pragma once
#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::fitting {

/// Faces as codes, each with labels: values of controls, or 0 and 1.
struct LabelledCodes {
  Eigen::MatrixXd codes;           ///< N x M, standardised, a row a face.
  std::vector<std::string> names;  ///< L
  Eigen::MatrixXd labels;          ///< N x L; NaN: not labelled.
};

/// A direction of codes along which a label grows.
struct CodeDirection {
  Eigen::VectorXd step;  ///< M: moves the label by one deviation of the faces that carry it, as far as it is linear.
  double accuracy = 0;   ///< Share of the faces held out (every fifth) on the right side of the middle of the means.
  int num_low = 0, num_high = 0;  ///< Faces of the two means, those held out left out.
};

/// Direction by difference of means [Shen et al. 2020, whose SVM on codes shorter than 0.1 is just that]: the mean code
/// of faces with the label less that of faces without it. Of a label of more than two values those in the upper and the
/// lower third count. Its length is that step that raises the label by one deviation, by regression of the label on the
/// codes' places along the direction.
/// @throws Error if there is no such label, or fewer than four faces on a side.
CodeDirection DirectionOf(const LabelledCodes& faces, const std::string& label);

/// The part of a step that leaves other labels: its component orthogonal to their directions (conditional edits),
/// made as long again along its own direction. steps: of the labels that are kept.
/// @throws Error if nothing is left of it.
Eigen::VectorXd Keeping(const Eigen::VectorXd& step, const std::vector<Eigen::VectorXd>& steps);

}  // namespace daumier::fitting
