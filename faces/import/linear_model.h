#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// A linear face model as read from an external file: the whole mesh in its own unit and vertex numbers.
struct LinearFile {
  std::string source;                               ///< As FaceTemplate::source.
  geometry::PolygonMesh mean;                       ///< Mean neutral face.
  Eigen::MatrixXf identity_shapes;                  ///< 3V x S: the displacement of one standard deviation each.
  std::vector<std::string> expression_shape_names;  ///< E
  Eigen::MatrixXf expression_shapes;                ///< 3V x E
  std::vector<Expression> expressions;              ///< The first is "neutral".
  double cm_per_unit = 1;                           ///< Used if the annotation has none.
  Json provenance;                                  ///< Without the checksum.
};

/// Scales to cm, annotates the mean (Completeness::kLandmarks) and crops every shape like it. Every identity shape gets
/// a Gaussian control of its own with sigma 1, so that identity weights are standard normal.
/// @throws Error as Annotate.
FaceModel ImportLinearModel(const LinearFile& file, const AnnotationFile& annotation);

/// E zeros under the name "neutral".
Expression NeutralExpression(size_t num_shapes);

/// STEM_00, STEM_01, ... or from another first number.
std::vector<std::string> NumberedShapes(const std::string& stem, Eigen::Index count, int first = 0);

/// Expressions of statistical modes that have no names: "neutral", and of each of the first 12 modes "NAME_plus" and
/// "NAME_minus", two standard deviations to either side. The shapes before `first_mode` have the weight 1 in all but
/// neutral.
std::vector<Expression> ExpressionsOfModes(const std::vector<std::string>& shape_names, int first_mode = 0);

}  // namespace daumier::faces
