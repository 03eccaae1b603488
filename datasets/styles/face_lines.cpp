#include "datasets/styles/face_lines.h"

#include "datasets/styles/drawing_raster.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

/// An error of the frame about the middle of the canvas.
render::Placement DrawError(const StyledShare& options, Rng& rng) {
  render::Placement error{.scale = std::exp(options.scale * rng.Normal()),
                          .turn_degrees = options.turn_degrees * rng.Normal()};
  const Eigen::Vector2d middle = Eigen::Vector2d::Constant(0.5 * render::kSketchCanvas);
  const Eigen::Vector2d shift(options.shift_px * rng.Normal(), options.shift_px * rng.Normal());
  error.shift = middle + shift - render::ToCanvas(error, middle);
  return error;
}

std::vector<render::Stroke> MapLines(std::vector<render::Stroke> lines, const render::Placement& pose,
                                     const render::Placement& error) {
  return render::MapToCanvas(render::MapToCanvas(lines, render::Inverse(pose)), error);
}

}  // namespace

StyleOptions StyledShare::DrawnAsTheFaceIs() {
  StyleOptions styles;
  styles.doodles = 0.1;
  for (FeatureStyles* features : {&styles.features, &styles.doodle_features}) {
    features->mouth.opened = features->mouth.closed = 0;
    features->eyes.closed = features->eyes.wink = 0;
  }
  styles.proportions.parts = 0.03;
  styles.proportions.whole = 0.01;
  return styles;
}

bool ShowsFace(faces::LineLabel label) {
  using enum faces::LineLabel;
  return label != kHair && label != kNeck && label != kOther && label != kEar;
}

std::vector<render::Stroke> FaceLines(const StyledDrawing& drawing, const render::Placement& error) {
  std::vector<render::Stroke> lines = LabelledStrokes(drawing);
  std::erase_if(lines, [](const render::Stroke& line) { return !ShowsFace(faces::LineLabel(line.kind)); });
  return MapLines(std::move(lines), drawing.pose, error);
}

std::vector<render::Stroke> DrawFaceLines(const FaceShape& shape, const StyledShare& options, Rng& rng) {
  const StyledDrawing drawing = DrawInStyle(shape, options.styles, rng);
  const double wrong = options.mislabelled * rng.Uniform();
  std::vector<render::Stroke> all = LabelledStrokes(drawing), lines;
  for (const render::Stroke& line : all)
    if (ShowsFace(faces::LineLabel(line.kind)) != (rng.Uniform() < wrong)) lines.push_back(line);
  if (lines.empty()) lines = std::move(all);
  return MapLines(std::move(lines), drawing.pose, DrawError(options, rng));
}

}  // namespace daumier::datasets
