#pragma once
#include "faces/face_model.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// What a caricaturist treats one by one, as soft weights over a template.
struct FaceParts {
  std::vector<std::string> names;  ///< "nose", "chin", "jaw_left", ...: FacePartNames().
  Eigen::MatrixXd weights;         ///< V x P in [0, 1]; a row sums to 1 on the face, to 0 on skull and neck.
  std::vector<int> mirror;         ///< P: the part on the other side; itself for parts on the midline.
};

/// nose, chin, mouth, forehead, and left and right of jaw, cheek, brow, eye and ear, in the order of FaceParts::names.
const std::vector<std::string>& FacePartNames();

/// Every vertex of the annotation's region `face` belongs to the part whose seeds, among the 68 landmarks, are
/// nearest; the regions nose and ears are parts unchanged; the neck's border and what is outside of the face belong
/// to none. Then weights are averaged `blend_rings` times over neighbours, so that parts pass into each other.
/// Promises: weights are symmetric where the template is; a row never sums to more than 1.
/// @throws Error naming a region that the annotation lacks.
FaceParts MakeFaceParts(const FaceTemplate& face_template, int blend_rings);

}  // namespace daumier::faces
