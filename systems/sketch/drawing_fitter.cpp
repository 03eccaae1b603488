#include "systems/sketch/drawing_fitter.h"

#include "core/error.h"
#include "geometry/coordinates.h"
#include "systems/sketch/parsed_face.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace daumier::sketch {
namespace {

const faces::FaceGaussian& GaussianOf(const SketchRunFolder& run) {
  DAUMIER_CHECK(
      run.models.gaussian.size() > 0,
      "{}: the run has no gaussian.safetensors, from which faces are fitted to drawings; it was trained by an "
      "earlier version. Train again, or predict sketches of the training's own frame by --keep-frame",
      run.directory.string());
  return run.models.gaussian;
}

}  // namespace

fitting::LabelledDrawing ToLabelled(const ParsedDrawing& drawing, const render::Placement& canvas_from_sheet,
                                    double least_support) {
  fitting::LabelledDrawing labelled;
  const std::array<double, faces::kNumFacePoints> support = SupportOf(drawing);
  for (size_t i = 0; i < drawing.points.size(); ++i)
    labelled.points[i] = {render::ToCanvas(canvas_from_sheet, drawing.points[i]),
                          drawing.confidences[i] * (least_support + (1 - least_support) * support[i])};
  const std::vector<render::Stroke> strokes = render::MapToCanvas(drawing.strokes, canvas_from_sheet);
  for (size_t s = 0; s < strokes.size(); ++s) labelled.strokes.push_back({strokes[s].points, drawing.labels[s]});
  labelled.mouth = drawing.mouth;
  labelled.eyes = drawing.eyes;
  labelled.view = drawing.view;
  return labelled;
}

double NumFeatures(const ParsedDrawing& drawing) {
  // Points of a feature are neighbours; the centres of the eyes come last.
  using enum faces::FacePoint;
  constexpr std::array<std::pair<faces::FacePoint, faces::FacePoint>, 6> kFeatures = {
      {{kEyeRightOuter, kEyeRightBottom},
       {kEyeLeftInner, kEyeLeftBottom},
       {kBrowRightOuter, kBrowLeftOuter},
       {kNoseBottom, kNoseWingLeft},
       {kMouthRight, kInnerBottom},
       {kChin, kContourLeft}}};
  const std::array<double, faces::kNumFacePoints> support = SupportOf(drawing);
  double num = 0;
  for (const auto& [first, last] : kFeatures) {
    double best = *std::max_element(support.begin() + int(first), support.begin() + int(last) + 1);
    if (first == kEyeRightOuter) best = std::max(best, support[size_t(kEyeRightCentre)]);
    if (first == kEyeLeftInner) best = std::max(best, support[size_t(kEyeLeftCentre)]);
    num += best;
  }
  return num;
}

double TrustOf(double num_features, double half_trust) {
  if (half_trust <= 0) return 1;
  constexpr double kSteepness = 8;
  const double n = std::pow(num_features, kSteepness);
  return n / (n + std::pow(half_trust, kSteepness));
}

DrawingFitter::DrawingFitter(const SketchRunFolder& run, std::shared_ptr<const DrawingParser> parser,
                             const DrawingFitOptions& options)
    : parser_(std::move(parser)),
      options_(options),
      fitter_(run.face_template, run.camera, GaussianOf(run), options.solver),
      points_(faces::FindFacePoints(run.face_template)),
      camera_(run.camera),
      resting_face_(run.face_template.neutral.transpose().reshaped().cast<float>()) {
  const Eigen::VectorXf& mean = run.models.gaussian.mean;
  mean_projected_ =
      render::Project(run.camera, geometry::PointsFrom(std::span(mean.data(), size_t(mean.size())))).leftCols<2>();
}

render::Placement DrawingFitter::FrameOf(const ParsedDrawing& drawing, std::span<const float> vertices) const {
  return FrameOn(drawing, render::Project(camera_, geometry::PointsFrom(vertices)).leftCols<2>());
}

render::Placement DrawingFitter::FrameOn(const ParsedDrawing& drawing, const Eigen::MatrixX2d& projected) const {
  const auto frame = fitting::FindFaceFrame(
      points_, projected, ToLabelled(drawing, drawing.frame, options_.least_support), options_.solver.frame);
  DAUMIER_CHECK(frame.has_value(), "no point of a face is found in the drawing. Is it one face, drawn by lines?");
  return render::Composed(render::Inverse(*frame), drawing.frame);
}

fitting::LabelledFit DrawingFitter::Fit(const ParsedDrawing& drawing, const render::Placement& frame,
                                        std::span<const float> predicted) const {
  const fitting::FacePrior prior{faces::CoefficientsOf(fitter_.gaussian(), predicted), options_.prior_share};
  std::optional<fitting::LabelledFit> fit = fitter_.Fit(ToLabelled(drawing, frame, options_.least_support), prior);
  DAUMIER_CHECK(fit.has_value(), "no point of a face is found in the drawing. Is it one face, drawn by lines?");
  const auto trust = float(TrustOf(NumFeatures(drawing), options_.half_trust));
  const std::vector<float> resting = fitting::TurnedAs(*fit, resting_face_);
  for (size_t i = 0; i < resting.size(); ++i) fit->vertices[i] = trust * fit->vertices[i] + (1 - trust) * resting[i];
  fit->coefficients = trust * fit->coefficients +
                      (1 - trust) * faces::CoefficientsOf(fitter_.gaussian(), std::span(resting_face_.data(),
                                                                                        size_t(resting_face_.size())));
  return *std::move(fit);
}

FittedFace DrawingFitter::FittedTo(const std::vector<render::Stroke>& sketch, std::span<const float> predicted) const {
  const ParsedDrawing parsed = Parse(sketch);
  const render::Placement frame = FrameOf(parsed);
  const fitting::LabelledFit fit = Fit(parsed, frame, predicted);
  return {fitting::Upright(fit), render::Composed(render::Inverse(fit.frame), frame)};
}

}  // namespace daumier::sketch
