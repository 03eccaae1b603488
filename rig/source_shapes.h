#pragma once

#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::rig {

/// The 52 expressions of ArkitNames() as displacements of a model's template.
struct SourceShapes {
  /// 3V x 52, cm; a column of zeros where the source has nothing to make it of, and for mouthClose, which FaceContact
  /// makes of jawOpen, and tongueOut, which no skin has.
  Eigen::MatrixXf shapes;
  std::vector<std::string> warnings;  ///< Name and reason of each column of zeros but those two.
};

/// From the expression shapes of a model.
/// - makehuman: sums of its expression units, parts of them and directions (MakeHumanShape).
/// - Any other source: shapes of the same name in any spelling (FindArkitName), or that of each side summed
///   (IctShapesOf).
/// @throws Error if the model has no shape of any of the names.
SourceShapes ArkitShapesOf(const faces::FaceModel& model);

}  // namespace daumier::rig
