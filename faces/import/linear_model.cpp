#include "faces/import/linear_model.h"

#include "core/error.h"
#include "faces/annotate.h"
#include "faces/model_shapes.h"

#include <algorithm>

namespace daumier::faces {

namespace {

constexpr int kNumModes = 12;
constexpr float kModeSigmas = 2;

/// The rows of the kept vertices of shapes in the source's unit, in cm.
Eigen::MatrixXf CropShapes(const Eigen::MatrixXf& shapes, double cm_per_unit, const geometry::VertexMap& map) {
  Eigen::MatrixXf kept(3 * map.old_from_new.size(), shapes.cols());
  for (Eigen::Index shape = 0; shape < shapes.cols(); ++shape) {
    for (size_t v = 0; v < map.old_from_new.size(); ++v) {
      kept.col(shape).segment<3>(3 * Eigen::Index(v)) =
          shapes.col(shape).segment<3>(3 * map.old_from_new[v]) * static_cast<float>(cm_per_unit);
    }
  }
  return kept;
}

}  // namespace

FaceModel ImportLinearModel(const LinearFile& file, const AnnotationFile& annotation) {
  const double cm_per_unit = annotation.cm_per_unit.value_or(file.cm_per_unit);
  geometry::PolygonMesh mean = file.mean;
  mean.vertices *= cm_per_unit;
  AnnotatedTemplate annotated = Annotate(mean, annotation, file.source, Completeness::kLandmarks);
  FaceModel model;
  model.face_template = std::move(annotated.face_template);
  model.identity_shapes = CropShapes(file.identity_shapes, cm_per_unit, annotated.vertices);
  for (int s = 0; s < model.identity_shapes.cols(); ++s) {
    model.identity_controls.push_back({.name = fmt::format("identity_{:03}", s),
                                       .kind = IdentityControl::Kind::kGaussian,
                                       .shapes = {s},
                                       .sigma = 1.0});
  }
  model.expression_shape_names = file.expression_shape_names;
  model.expression_shapes = CropShapes(file.expression_shapes, cm_per_unit, annotated.vertices);
  model.expressions = file.expressions;
  model.face_template.provenance = file.provenance;
  model.face_template.provenance["checksum"] = ModelChecksum(model);
  return model;
}

Expression NeutralExpression(size_t num_shapes) {
  return {"neutral", Eigen::VectorXf::Zero(num_shapes)};
}

std::vector<std::string> NumberedShapes(const std::string& stem, Eigen::Index count, int first) {
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < count; ++i) names.push_back(fmt::format("{}_{:02}", stem, i + first));
  return names;
}

std::vector<Expression> ExpressionsOfModes(const std::vector<std::string>& shape_names, int first_mode) {
  std::vector<Expression> expressions = {NeutralExpression(shape_names.size())};
  const int end = std::min(static_cast<int>(shape_names.size()), first_mode + kNumModes);
  for (int mode = first_mode; mode < end; ++mode) {
    for (const auto& [side, sigmas] : {std::pair("plus", kModeSigmas), {"minus", -kModeSigmas}}) {
      Expression& expression = expressions.emplace_back(NeutralExpression(shape_names.size()));
      expression.name = fmt::format("{}_{}", shape_names[mode], side);
      expression.weights.head(first_mode).setOnes();
      expression.weights[mode] = sigmas;
    }
  }
  return expressions;
}

}  // namespace daumier::faces
