#pragma once
#include "fitting/code_model.h"

#include <span>

namespace daumier::fitting {

/// The automatic caricature of a face by a deformable model [Jung et al. 2022, section 5]: with its code c = CodeOfMesh,
///   face + V(c + strength d) - V(c),  d = c less its numbers of expression,
/// so that what the model cannot show of the face stays as it is; towards the border of the neck (region neck_border), within
/// 4 cm of it, what is added becomes the border's mean. What is added is its own mirror image where the template is: an
/// asymmetry stays as it is. Codes are standardised: 0 is the mean face.
/// Large shares of faces that are caricatures already may fold: codes longer than CodeModel::usual_radius.
/// face: V x 3, cm; expression: numbers of the code that are one. Strength 0 gives the face itself.
/// @throws Error as CodeOfMesh.
struct ExaggeratedFace {
  geometry::Points vertices;  ///< V x 3, cm.
  double radius = 0;          ///< |c + strength d|
};
ExaggeratedFace Exaggerate(const CodeModel& model, const geometry::Points& face, double strength,
                           std::span<const int> expression = {});

}  // namespace daumier::fitting
