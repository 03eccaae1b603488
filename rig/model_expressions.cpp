#include "rig/model_expressions.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <algorithm>

namespace daumier::rig {
namespace {

constexpr const char* kMeanExpression = "mean_expression";

ModelExpressions OfModel(const faces::FaceModel& model) {
  ModelExpressions result{model.face_template, model.expression_shape_names, model.expression_shapes};
  const std::string& source = model.face_template.source;
  if (source == "flame" || source == "bfm") result.kind = CoefficientKind::kSigned;
  const auto mean = std::ranges::find(result.names, kMeanExpression);
  if (source == "bfm" && mean != result.names.end()) result.constant = int(mean - result.names.begin());
  return result;
}

ModelExpressions OfFaces(const faces::GivenFaces& given) {
  ModelExpressions result{given.face_template, {}, {}};
  const size_t num_shapes = given.expressions.empty() ? 0 : given.expressions.size() - 1;
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(given.face_template.neutral.size(), Eigen::Index(num_shapes));
  for (int person = 0; person < std::ssize(given.names); ++person) {
    if (num_shapes == 0) break;
    const geometry::Points neutral = given.face(person, 0);
    for (size_t e = 0; e < num_shapes; ++e) {
      const geometry::Points offset = given.face(person, int(e) + 1) - neutral;
      sums.col(Eigen::Index(e)) += Eigen::Map<const Eigen::VectorXd>(offset.data(), offset.size());
    }
  }
  if (num_shapes > 0) result.names.assign(given.expressions.begin() + 1, given.expressions.end());
  result.shapes = (sums / std::max<double>(1, double(given.names.size()))).cast<float>();
  return result;
}

}  // namespace

ModelExpressions ExpressionsOf(const std::variant<faces::FaceModel, faces::GivenFaces>& source) {
  const auto* const model = std::get_if<faces::FaceModel>(&source);
  ModelExpressions result = model ? OfModel(*model) : OfFaces(std::get<faces::GivenFaces>(source));
  DAUMIER_CHECK(
      !result.names.empty(),
      "the source {} ({}) has no expressions, only neutral faces. Use an edition with expressions: of the Basel "
      "Face Model 2017 or 2019, of FaceWarehouse the blendshapes",
      result.face_template.source, result.face_template.provenance.value("version", "unknown version"));
  DAUMIER_CHECK(result.shapes.allFinite(), "the source {} has an expression that is not finite",
                result.face_template.source);
  result.has_gaze = std::ranges::any_of(result.names, [](const std::string& name) {
    const auto index = FindArkitName(name);
    return index && ArkitNames()[size_t(*index)].starts_with("eyeLook");
  });
  return result;
}

}  // namespace daumier::rig
