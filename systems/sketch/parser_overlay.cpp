#include "systems/sketch/parser_overlay.h"

#include "datasets/styles/drawing_raster.h"
#include "render/draw.h"

namespace daumier::sketch {

std::vector<render::Stroke> LabelRuns(const ParsedDrawing& drawing) {
  std::vector<render::Stroke> runs;
  for (size_t s = 0; s < drawing.strokes.size(); ++s) {
    const auto& points = drawing.strokes[s].points;
    const auto& labels = drawing.labels[s];
    for (size_t begin = 0; begin < points.size();) {
      size_t end = begin + 1;
      while (end < points.size() && labels[end] == labels[begin]) ++end;
      const size_t last = std::min(end, points.size() - 1);  // Runs meet at a point.
      runs.push_back({int(labels[begin]), {points.begin() + ptrdiff_t(begin), points.begin() + ptrdiff_t(last + 1)}});
      begin = end;
    }
  }
  return runs;
}

render::Image ParsedPicture(const ParsedDrawing& drawing, const render::Placement& canvas_from_sheet, int side) {
  render::Image image = datasets::ColouredStrokes(render::MapToCanvas(LabelRuns(drawing), canvas_from_sheet), side);
  const double scale = double(side) / render::kSketchCanvas;
  for (size_t i = 0; i < drawing.points.size(); ++i) {
    const Eigen::Vector2d at = scale * render::ToCanvas(canvas_from_sheet, drawing.points[i]);
    const auto pale = uint8_t(200 * (1 - drawing.confidences[i]));
    render::FillRectangle(image, int(at.y()) - 1, int(at.x()) - 1, 3, 3, {255, pale, 255});
  }
  return image;
}

}  // namespace daumier::sketch
