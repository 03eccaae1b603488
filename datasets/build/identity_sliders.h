#pragma once
#include "faces/face_database.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace daumier::datasets {

/// What made a person's identity, as numbers that a user would move: linear functions of the weights (S) of the
/// source's identity shapes.
struct IdentitySliders {
  std::vector<std::string> names;  ///< A
  Eigen::MatrixXf from_weights;    ///< A x S
};

/// The controls of a source as a faces manifest stores them (`details.identity_controls`, docs/formats.md).
Json IdentityControlsToJson(const std::vector<faces::IdentityControl>& controls);

/// One slider a control, by its name: the weight of its shape, or of two opposite ones the second less the first, so
/// that both ends of a bipolar control are one number between -1 and 1; of a mixture one a part, numbered from 1. Where
/// the manifest has no controls each weight is a slider: identity_0, identity_1 ... None where not every person has
/// equally many weights. @throws Error if a control names a weight that no person has, or is malformed.
IdentitySliders SlidersOf(const faces::FaceDatabase& database);

}  // namespace daumier::datasets
