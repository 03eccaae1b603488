#pragma once
#include "core/json.h"
#include "faces/face_model.h"

#include <Eigen/Core>

namespace daumier::faces {

/// The frame of a network that works on positions: p_model = scale * p_cm + offset.
struct ModelFrame {
  double scale = 1;                                  ///< Model units in a centimetre, > 0.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< Model units.

  geometry::Points FromCm(const geometry::Points& points) const;
  /// Undoes FromCm.
  geometry::Points ToCm(const geometry::Points& points) const;
};

/// The frame in which a template's neutral head is `head_height` units high, from the chin (landmark 8) to its top
/// along y, and placed like the template of [Jung et al. 2022], whose head is 2.1 units high: the chin at y = -0.71,
/// the foremost vertex at z = 0.63, both times head_height / 2.1, and the middle of the bounding box at x = 0.
/// @throws Error if the chin is the highest vertex or head_height is not positive.
ModelFrame HeadFrame(const FaceTemplate& face_template, double head_height);

/// For manifests and models: {scale, offset} with an offset of three numbers.
Json ModelFrameToJson(const ModelFrame& frame);
/// Undoes ModelFrameToJson, to the bit. @throws Error or Json::exception if a number is missing, there are too many, or
/// the scale is not positive.
ModelFrame ModelFrameFromJson(const Json& json);

}  // namespace daumier::faces
