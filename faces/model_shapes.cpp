#include "faces/model_shapes.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>

namespace daumier::faces {

Eigen::VectorXf ShapeColumn(const geometry::Points& displacement, const geometry::VertexMap& map) {
  const geometry::Points kept = geometry::SelectPoints(displacement, map);
  return Eigen::Map<const Eigen::VectorXd>(kept.data(), kept.size()).cast<float>();
}

std::vector<Expression> MakeExpressions(const std::vector<ExpressionRecipe>& recipes, const FaceModel& model) {
  const auto& names = model.expression_shape_names;
  std::vector<Expression> expressions;
  for (const ExpressionRecipe& recipe : recipes) {
    Expression& expression = expressions.emplace_back();
    expression.name = recipe.name;
    expression.weights = Eigen::VectorXf::Zero(names.size());
    for (const auto& [shape, weight] : recipe.weights) {
      const auto found = std::find(names.begin(), names.end(), shape);
      DAUMIER_CHECK(found != names.end(), "expression '{}' of {} uses the shape '{}', which the source does not have",
                    recipe.name, model.face_template.source, shape);
      expression.weights[found - names.begin()] = weight;
    }
  }
  return expressions;
}

std::string ModelChecksum(const FaceModel& model) {
  const auto digest = [](const auto& matrix) {
    return Sha256(
        {reinterpret_cast<const char*>(matrix.data()), sizeof(*matrix.data()) * static_cast<size_t>(matrix.size())});
  };
  return Sha256(digest(model.face_template.neutral) + digest(model.identity_shapes) + digest(model.expression_shapes));
}

}  // namespace daumier::faces
