#pragma once
#include "faces/controls/face_controls.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// By how much two controls together differ from the sum of both, at one value v of each (both sides of a pair):
///   |A(v e_i + v e_j) - A(v e_i) - A(v e_j) + A(0)|  at each vertex, A the controls applied to a face.
struct PairComposition {
  std::string first, second;
  double mean_mm;  ///< Over the vertices of the annotation's region `face`.
  double max_mm;   ///< The largest of these.
  double share;    ///< mean_mm over the mean displacement by both.
};

/// All pairs of controls on the neutral template, those that differ most (by max_mm) first. Millimetres as
/// MillimetresPerCm. @throws Error if the annotation lacks the region.
std::vector<PairComposition> MeasureComposition(const FaceControls& controls, const FaceTemplate& face_template,
                                                double value);

}  // namespace daumier::faces
