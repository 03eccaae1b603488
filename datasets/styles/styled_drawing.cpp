#include "datasets/styles/styled_drawing.h"

#include "core/error.h"
#include "render/strokes.h"

namespace daumier::datasets {
namespace {

constexpr double kMirrorWidth = render::kSketchCanvas;

template <class T>
void Limit(ShownWith<T>& shown, int num_strokes) {
  if (shown.num_strokes > num_strokes) shown = {};
}

}  // namespace

StyledDrawing FirstStrokes(StyledDrawing drawing, int num_strokes) {
  DAUMIER_CHECK(num_strokes >= 1 && num_strokes <= static_cast<int>(drawing.strokes.size()),
                "the first {} strokes of a drawing of {}", num_strokes, drawing.strokes.size());
  drawing.strokes.resize(static_cast<size_t>(num_strokes));
  for (auto& point : drawing.points) Limit(point, num_strokes);
  Limit(drawing.mouth, num_strokes);
  for (auto& eye : drawing.eyes) Limit(eye, num_strokes);
  Limit(drawing.view, num_strokes);
  return drawing;
}

StyledDrawing Mirrored(StyledDrawing drawing) {
  const auto flip = [](std::array<float, 2>& p) { p[0] = static_cast<float>(kMirrorWidth) - p[0]; };
  for (StyledStroke& stroke : drawing.strokes)
    for (auto& point : stroke.points) flip(point);
  const auto points = drawing.points;
  for (size_t i = 0; i < points.size(); ++i) {
    auto& point = drawing.points[size_t(MirroredPoint(faces::FacePoint(i)))] = points[i];
    if (point.is_shown()) flip(point.value);
  }
  std::swap(drawing.eyes[0], drawing.eyes[1]);
  if (drawing.view.value == faces::DrawnView::kThreeQuarterLeft)
    drawing.view.value = faces::DrawnView::kThreeQuarterRight;
  else if (drawing.view.value == faces::DrawnView::kThreeQuarterRight)
    drawing.view.value = faces::DrawnView::kThreeQuarterLeft;
  // M (s R (M p) + t) with M the reflection about x = side / 2.
  const Eigen::Vector2d corner = render::ToCanvas(drawing.pose, {kMirrorWidth, 0});
  drawing.pose.turn_degrees = -drawing.pose.turn_degrees;
  drawing.pose.shift = {kMirrorWidth - corner[0], corner[1]};
  return drawing;
}

}  // namespace daumier::datasets
