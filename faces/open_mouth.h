#pragma once
#include "faces/face_model.h"

#include <vector>

namespace daumier::faces {

/// The inner contours of the lips as vertex paths along mesh edges, from the right corner of the mouth (landmark 60) to
/// the left one (64), both included: along 61..63 and along 67..65.
struct LipContours {
  std::vector<int> upper, lower;
};
/// @throws Error as geometry::TracePath, or if the lips share their middle.
LipContours FindLipContours(const FaceTemplate& face_template);

/// The neutral face, V x 3 cm, with its lips apart: no two vertices that must move apart when a mouth opens share a
/// place, where a continuous map of positions could not separate them.
/// A vertex of the lower contour goes straight down until the upper contour is, at its x, at least
///   gap_cm (1 - t^2)
/// above it along y, t the share of its way from the middle (landmark 66) to the corner of its side. The upper contour
/// and all vertices farther from the contours than the mouth is wide keep their places, and the harmonic function of
/// these values (cotangent Laplacian of the neutral face) moves those between them, with no condition where the
/// surface ends.
/// So the middle is open by gap_cm or, if that is more, by what it was; the corners stay; lips that are apart that much
/// everywhere do not move at all.
/// @throws Error as FindLipContours, geometry::CotangentLaplacian and geometry::PoissonSolver, or if gap_cm is
/// negative.
geometry::Points OpenMouth(const FaceTemplate& face_template, double gap_cm);

}  // namespace daumier::faces
