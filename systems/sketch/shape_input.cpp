#include "systems/sketch/shape_input.h"

#include "core/error.h"
#include "datasets/read/curve_coefficients.h"

#include <cmath>

namespace daumier::sketch {
namespace {

std::vector<std::string> FeatureNames(const datasets::SketchDatabase& sketches) {
  std::vector<std::string> names;
  for (const int feature : sketches.feature_curves()) names.push_back(sketches.curve_names()[size_t(feature)]);
  return names;
}

}  // namespace

ShapeInput::ShapeInput(const faces::BilinearModel& curves, const datasets::SketchDatabase& sketches,
                       const faces::FaceTemplate& face_template, const faces::CurveEncoderOptions& options)
    : sketches_(sketches),
      encoder_(curves, options),
      projected_(fitting::SeeCurves(face_template, FeatureNames(sketches), sketches.camera())) {}

faces::CurveCode ShapeInput::Given(const std::vector<render::Stroke>& strokes,
                                   const std::vector<std::vector<bool>>& visible) const {
  return datasets::GivenShape(encoder_, sketches_, strokes, visible);
}

faces::CurveCode ShapeInput::Recovered(std::span<const float> predicted_face, const std::vector<render::Stroke>& drawn,
                                       const fitting::CurveRecoveryOptions& options) const {
  return fitting::RecoverCurves(encoder_, projected_.offsets, fitting::Project(projected_, predicted_face), drawn,
                                options);
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

}  // namespace daumier::sketch
