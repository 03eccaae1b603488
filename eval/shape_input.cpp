#include "eval/shape_input.h"

#include "core/error.h"
#include "datasets/read/shape_numbers.h"

#include <algorithm>
#include <cmath>

namespace daumier::eval {

ShapeInput::ShapeInput(const faces::BilinearModel& curves, const datasets::SketchDatabase& sketches,
                       const faces::FaceTemplate& face_template, const faces::CurveEncoderOptions& options)
    : sketches_(sketches), encoder_(curves, options), camera_(sketches.camera()) {
  const auto& annotated = face_template.annotation.curves;
  for (const int feature : sketches.feature_curves()) {
    const std::string& name = sketches.curve_names()[size_t(feature)];
    const auto curve = std::find_if(annotated.begin(), annotated.end(), [&](const auto& c) { return c.name == name; });
    DAUMIER_CHECK(curve != annotated.end(), "the template has no curve '{}', which its sketches show", name);
    vertices_.insert(vertices_.end(), curve->vertices.begin(), curve->vertices.end());
    if (curve->closed) vertices_.push_back(curve->vertices.front());
    offsets_.push_back(static_cast<int>(vertices_.size()));
  }
}

faces::CurveCode ShapeInput::Given(const std::vector<render::Stroke>& strokes,
                                   const std::vector<std::vector<bool>>& visible) const {
  return datasets::GivenShape(encoder_, sketches_, strokes, visible);
}

faces::CurveCode ShapeInput::Recovered(std::span<const float> predicted_face, const std::vector<render::Stroke>& drawn,
                                       const fitting::CurveRecoveryOptions& options) const {
  geometry::Points points(Eigen::Index(vertices_.size()), 3);
  for (size_t k = 0; k < vertices_.size(); ++k) {
    for (int axis = 0; axis < 3; ++axis)
      points(Eigen::Index(k), axis) = predicted_face[3 * size_t(vertices_[k]) + size_t(axis)];
  }
  const geometry::Points projected = render::Project(camera_, points);
  std::vector<float> predicted;
  for (const auto& point : projected.rowwise()) predicted.insert(predicted.end(), {float(point.x()), float(point.y())});
  return fitting::RecoverCurves(encoder_, offsets_, predicted, drawn, options);
}

double ShapeInput::ErrorPx(const faces::CurveCode& code, const std::vector<render::Stroke>& truth) const {
  const std::vector<float> points = datasets::PointsOf(truth, sketches_.feature_curves());
  DAUMIER_CHECK(Eigen::Index(points.size()) == code.points.size(), "curves of {} coordinates, expected {}",
                points.size(), code.points.size());
  double sum = 0;
  for (size_t k = 0; k < points.size(); k += 2) {
    const auto row = Eigen::Index(k);
    sum += std::hypot(double(code.points[row]) - points[k], double(code.points[row + 1]) - points[k + 1]);
  }
  return 2 * sum / double(points.size());
}

}  // namespace daumier::eval
