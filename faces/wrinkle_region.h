#pragma once
#include "faces/face_model.h"

#include <vector>

namespace daumier::faces {

/// The vertices, ascending, among which lines of a face are wrinkles in a view [Han et al. 2017, figure 3 b]: the
/// annotation's region `wrinkles` where it has one. Otherwise the region `face` inside of the frontal silhouette
/// curves, as far as it can be reached from the tip of the nose without crossing them or an ear, and of that what
///   - faces the viewer: its normal on the neutral face is at most 65 degrees away from +z, or from -x in the side
///     view; vertices further around would double the silhouette;
///   - belongs neither to eyes, mouth or nose, as far as the annotation names them, nor lies nearer than `clearance_mm`
///     to a feature curve of the view, which draws that line already.
/// @throws Error if the annotation has neither region.
std::vector<int> WrinkleRegion(const FaceTemplate& face_template, View view, double clearance_mm);

}  // namespace daumier::faces
