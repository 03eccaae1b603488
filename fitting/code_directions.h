#pragma once
#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace daumier::fitting {

/// Faces as codes, each with labels: values of controls, or 0 and 1.
struct LabelledCodes {
  Eigen::MatrixXd codes;           ///< N x M, standardised, a row a face.
  std::vector<std::string> names;  ///< L
  Eigen::MatrixXd labels;          ///< N x L; NaN: not labelled.
};

/// How the direction of a label is found from the faces with and without it.
enum class DirectionMethod {
  kMeans,  ///< Difference of their mean codes.
  kSvm,    ///< Normal of the plane between them (TrainLinearSvm), of the cost that separates held-out faces best.
};

/// A direction of codes along which a label grows.
struct CodeDirection {
  Eigen::VectorXd step;  ///< M: moves the label by one deviation of the faces that carry it, as far as it is linear.
  double threshold = 0;  ///< Faces with the label are where the code's place along the unit direction is larger.
  double accuracy = 0;   ///< Share of the faces held out (every fifth) on the right side of the threshold.
  int num_low = 0, num_high = 0;  ///< Faces without and with the label, those held out left out.
};

/// The direction of a label: by difference of means [Shen et al. 2020, whose SVM on codes shorter than 0.1 is just that],
/// with the threshold in the middle of the means, or by a support vector machine on the standardised codes, with its
/// own. Of a label of more than two values those in the upper and the lower third count. Its length is that step that
/// raises the label by one deviation, by regression of the label on the codes' places along the direction.
/// @throws Error if there is no such label, or fewer than four faces on a side.
CodeDirection DirectionOf(const LabelledCodes& faces, const std::string& label,
                          DirectionMethod method = DirectionMethod::kMeans);

/// The share of faces that a direction puts on the side of their label; of a label of more than two values those in the
/// upper and the lower third count. Absent if there are none of one side. @throws Error if there is no such label.
std::optional<double> AccuracyOn(const LabelledCodes& faces, const std::string& label, const CodeDirection& direction);

/// The part of a step that leaves other labels: its component orthogonal to their directions (conditional edits),
/// made as long again along its own direction. steps: of the labels that are kept.
/// @throws Error if nothing is left of it.
Eigen::VectorXd Keeping(const Eigen::VectorXd& step, const std::vector<Eigen::VectorXd>& steps);

}  // namespace daumier::fitting
