#include "rig/source_shapes.h"

#include "core/error.h"
#include "rig/arkit_names.h"
#include "rig/makehuman_units.h"

#include <algorithm>

namespace daumier::rig {
namespace {

/// Columns of the model's shapes whose sum is an expression; none if one is missing.
std::vector<Eigen::Index> ColumnsOfShape(const faces::FaceModel& model, int expression) {
  const auto& names = model.expression_shape_names;
  const auto same = std::ranges::find_if(names, [&](const auto& name) { return FindArkitName(name) == expression; });
  if (same != names.end()) return {same - names.begin()};
  std::vector<Eigen::Index> columns;
  for (const std::string& part : IctShapesOf(expression)) {
    const auto found = std::ranges::find(names, part);
    if (found == names.end()) return {};
    columns.push_back(found - names.begin());
  }
  return columns;
}

}  // namespace

SourceShapes ArkitShapesOf(const faces::FaceModel& model) {
  SourceShapes source;
  source.shapes = Eigen::MatrixXf::Zero(model.expression_shapes.rows(), kNumArkitNames);
  const std::string& source_name = model.face_template.source;
  const bool is_makehuman = source_name == "makehuman";
  const MakeHumanUnits units = is_makehuman ? MakeHumanUnits(model) : MakeHumanUnits();
  int num_found = 0;
  for (int e = 0; e < kNumArkitNames; ++e) {
    const std::string name(ArkitNames()[size_t(e)]);
    if (name == "mouthClose") continue;
    if (is_makehuman) {
      source.shapes.col(e) = units.Shape(e);
    } else {
      for (const Eigen::Index column : ColumnsOfShape(model, e))
        source.shapes.col(e) += model.expression_shapes.col(column);
    }
    if (!source.shapes.col(e).isZero(0)) {
      ++num_found;
    } else if (name != "tongueOut") {
      source.warnings.push_back(
          fmt::format("{}: the source {} has no shape to make it of; the target is empty", name, source_name));
    }
  }
  DAUMIER_CHECK(num_found > 0,
                "the source {} has no expression shape with a name of ARKit (found {} shapes). Use ict or makehuman",
                source_name, model.expression_shape_names.size());
  return source;
}

}  // namespace daumier::rig
