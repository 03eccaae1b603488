#pragma once
#include "faces/face_model.h"
#include "faces/import/given_faces.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace daumier::rig {

/// What a face model's expression coefficients may be.
enum class CoefficientKind {
  kSigned,  ///< Of statistical modes (FLAME, BFM): any number; an expression has two ends.
  kBlend,   ///< Of blendshapes (FaceWarehouse, FaceScape, ICT, MakeHuman): 0 .. 1.
};

/// Expressions of a face model as displacements of its mean neutral face.
struct ModelExpressions {
  faces::FaceTemplate face_template;
  std::vector<std::string> names;  ///< E
  Eigen::MatrixXf shapes;          ///< 3V x E, cm, at coefficient 1.
  CoefficientKind kind = CoefficientKind::kBlend;
  std::optional<int> constant = {};  ///< The shape whose coefficient is 1 in every expression: BFM's mean expression.
  bool has_gaze = false;             ///< Whether a shape has the name of one of ARKit's eyeLook*.
};

/// The expression shapes of a model; of given faces the mean over the persons of face - neutral.
/// Coefficient 1: FLAME, one unit of the file's directions; BFM, one standard deviation; others, the whole shape.
/// @throws Error naming the source if it has no expressions.
ModelExpressions ExpressionsOf(const std::variant<faces::FaceModel, faces::GivenFaces>& source);

}  // namespace daumier::rig
