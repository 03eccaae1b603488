#pragma once

#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// The 52 expressions of ArkitNames() as displacements of a model's template.
struct SourceShapes {
  Eigen::MatrixXf shapes;             ///< 3V x 52, cm; a column of zeros where the source has nothing to make it of.
  std::vector<std::string> warnings;  ///< One for each such column but tongueOut, which no skin has: name and reason.
};

/// From the expression shapes of a model.
/// - makehuman: sums of its expression units, parts of them and directions (MakeHumanShape).
/// - Any other source: shapes of the same name in any spelling (FindArkitName), or that of each side summed
///   (IctShapesOf).
/// @throws Error if the model has no shape of any of the names.
SourceShapes ArkitShapesOf(const faces::FaceModel& model);

}  // namespace daumier::rig
