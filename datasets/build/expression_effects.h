#pragma once
#include "faces/face_model.h"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <vector>

namespace daumier::datasets {

/// What an expression shape of full weight does to the mean face, measured at landmarks, so that shapes of any source
/// can be distinguished without their names.
struct ExpressionEffect {
  std::array<double, 2> closes{};  ///< Right and left eye: the share of the gap between the lids that it closes.
  double opens = 0;                ///< Growth of the gap between the lips, in widths of the neutral mouth.
  double smiles = 0;               ///< Mean rise and outward way of the mouth's corners, in widths of the mouth.
  double brows = 0;                ///< Mean rise of the brows, in distances between the eyes' outer corners.
  double lips_cross = 0;           ///< How far the lower lip passes through the upper one, in widths of the mouth.
  std::optional<int> mirrored;     ///< The shape that does the same on the other side, if it is another one.
};

/// An effect each column of `shapes` (3V x E, cm). @throws Error as faces::FindOpenings.
std::vector<ExpressionEffect> MeasureEffects(const faces::FaceTemplate& face_template, const Eigen::MatrixXf& shapes);

}  // namespace daumier::datasets
