#pragma once

#include "faces/face_model.h"

namespace daumier::rig {

/// V: the share of the left side (+x) in what both sides do: a smooth step over x, as wide as 1.2 mouths (landmarks 48
/// to 54). 1/2 in the middle; that of the right side is the rest.
Eigen::VectorXf ShareOfLeftSide(const faces::FaceTemplate& face_template);

/// V: the share of the upper lip in what both lips do: 1 on its contour, 0 on that of the lower lip, and a harmonic
/// function between them, made steeper. @throws Error as faces::FindLipContours.
Eigen::VectorXf ShareOfUpperLip(const faces::FaceTemplate& face_template);

/// V: the share of the lips in what a jaw does: 1 at the lips, and from the lower border of the lower lip (landmark 57)
/// smoothly to 0 at 0.9 of the distance between contour and chin (landmark 8).
/// @throws Error as faces::FindLipContours.
Eigen::VectorXf ShareOfLips(const faces::FaceTemplate& face_template);

}  // namespace daumier::rig
