#pragma once
#include "faces/annotation_file.h"
#include "faces/face_model.h"
#include "geometry/mesh.h"
#include "geometry/submesh.h"

#include <string>
#include <vector>

namespace daumier::faces {

/// The displacement of the kept vertices as a column of 3V, from that of all source vertices.
Eigen::VectorXf ShapeColumn(const geometry::Points& displacement, const geometry::VertexMap& map);

/// Turns recipes over named shapes into weights over model.expression_shape_names. @throws Error on an unknown shape.
std::vector<Expression> MakeExpressions(const std::vector<ExpressionRecipe>& recipes, const FaceModel& model);

/// Names the exact data that a model was made of: SHA-256 over neutral face, identity and expression shapes.
/// Independent of how the source is packed.
std::string ModelChecksum(const FaceModel& model);

}  // namespace daumier::faces
