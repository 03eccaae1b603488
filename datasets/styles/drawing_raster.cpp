#include "datasets/styles/drawing_raster.h"

#include "render/draw.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace daumier::datasets {
namespace {

/// All pixels whose centres lie inside a polygon (even-odd) become black.
void FillPolygon(const std::vector<std::array<float, 2>>& points, double scale, render::Image& image) {
  std::vector<double> crossings;
  float low = points.front()[1], high = low;
  for (const auto& point : points) low = std::min(low, point[1]), high = std::max(high, point[1]);
  const int first = std::max(0, static_cast<int>(std::ceil(low * scale - 0.5)));
  const int last = std::min(image.height - 1, static_cast<int>(std::floor(high * scale - 0.5)));
  for (int row = first; row <= last; ++row) {
    const double y = (row + 0.5) / scale;
    crossings.clear();
    for (size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
      const auto &a = points[i], &b = points[j];
      if ((a[1] > y) == (b[1] > y)) continue;
      crossings.push_back(a[0] + (y - a[1]) / (double(b[1]) - a[1]) * (double(b[0]) - a[0]));
    }
    std::sort(crossings.begin(), crossings.end());
    for (size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int begin = std::max(0, static_cast<int>(std::ceil(crossings[k] * scale - 0.5)));
      const int end = std::min(image.width - 1, static_cast<int>(std::floor(crossings[k + 1] * scale - 0.5)));
      for (int column = begin; column <= end; ++column) image.at(row, column) = 0;
    }
  }
}

render::Stroke PlainStroke(const StyledStroke& stroke) {
  render::Stroke plain{0, stroke.points};
  if (stroke.filled) plain.points.push_back(plain.points.front());
  return plain;
}

void DarkenWith(const render::Image& other, render::Image& image) {
  std::transform(image.pixels.begin(), image.pixels.end(), other.pixels.begin(), image.pixels.begin(),
                 [](uint8_t a, uint8_t b) { return std::min(a, b); });
}

}  // namespace

render::Image RasteriseDrawing(const StyledDrawing& drawing, int size, PenView view, double traced_width) {
  if (view == PenView::kTraced) {
    std::vector<render::Stroke> strokes;
    for (const StyledStroke& stroke : drawing.strokes) strokes.push_back(PlainStroke(stroke));
    return render::RasteriseStrokes(strokes, size, {.width = traced_width});
  }
  std::map<float, std::vector<render::Stroke>> by_width;
  for (const StyledStroke& stroke : drawing.strokes) by_width[stroke.width].push_back(PlainStroke(stroke));
  render::Image image(size, size, 1, 255);
  for (const auto& [width, strokes] : by_width)
    DarkenWith(render::RasteriseStrokes(strokes, size, {.width = width}), image);
  for (const StyledStroke& stroke : drawing.strokes)
    if (stroke.filled) FillPolygon(stroke.points, double(size) / render::kSketchCanvas, image);
  return image;
}

std::vector<render::Stroke> LabelledStrokes(const StyledDrawing& drawing) {
  std::vector<render::Stroke> strokes;
  for (const StyledStroke& stroke : drawing.strokes) {
    size_t begin = 0;
    for (size_t i = 1; i <= stroke.points.size(); ++i) {
      if (i < stroke.points.size() && stroke.labels[i] == stroke.labels[begin]) continue;
      render::Stroke& run = strokes.emplace_back(render::Stroke{static_cast<int>(stroke.labels[begin]), {}});
      // A run extends to the first point of the next one, so that no piece is lost.
      const size_t end = std::min(i + 1, stroke.points.size());
      run.points.assign(stroke.points.begin() + ptrdiff_t(begin), stroke.points.begin() + ptrdiff_t(end));
      if (stroke.filled && i == stroke.points.size()) run.points.push_back(stroke.points.front());
      begin = i;
    }
  }
  return strokes;
}

std::vector<int8_t> RasteriseLabels(const StyledDrawing& drawing, int side) {
  const size_t count = size_t(side) * size_t(side);
  std::vector<int8_t> labels(count, kNoLineLabel);
  std::vector<float> nearest(count, 1e9f);
  const auto scale = static_cast<float>(side) / render::kSketchCanvas;
  const auto visit = [&](float x, float y, int8_t label) {
    const int column = std::clamp(static_cast<int>(x), 0, side - 1), row = std::clamp(static_cast<int>(y), 0, side - 1);
    const float dx = x - (float(column) + 0.5f), dy = y - (float(row) + 0.5f), square = dx * dx + dy * dy;
    const size_t cell = size_t(row) * size_t(side) + size_t(column);
    if (square >= nearest[cell]) return;
    nearest[cell] = square;
    labels[cell] = label;
  };
  for (const render::Stroke& stroke : LabelledStrokes(drawing)) {
    const auto label = static_cast<int8_t>(stroke.kind);
    for (size_t i = 0; i < stroke.points.size(); ++i) {
      const float x = stroke.points[i][0] * scale, y = stroke.points[i][1] * scale;
      visit(x, y, label);
      if (i == 0) continue;
      const float from_x = stroke.points[i - 1][0] * scale, from_y = stroke.points[i - 1][1] * scale;
      const int steps = static_cast<int>(std::max(std::abs(x - from_x), std::abs(y - from_y)) * 3);
      for (int k = 1; k < steps; ++k) {
        const float t = float(k) / float(steps);
        visit(from_x + t * (x - from_x), from_y + t * (y - from_y), label);
      }
    }
  }
  return labels;
}

render::Image ColouredStrokes(const std::vector<render::Stroke>& labelled, int size) {
  render::Image image(size, size, 3, 255);
  for (int label = 0; label < faces::kNumLineLabels; ++label) {
    std::vector<render::Stroke> some;
    std::copy_if(labelled.begin(), labelled.end(), std::back_inserter(some),
                 [&](const auto& stroke) { return stroke.kind == label; });
    if (some.empty()) continue;
    const render::Image mask = render::RasteriseStrokes(some, size, {.width = 1.8});
    const render::Rgb colour = ColourOf(faces::LineLabel(label));
    for (size_t pixel = 0; pixel < mask.pixels.size(); ++pixel) {
      if (mask.pixels[pixel] == 255) continue;
      const int paper = mask.pixels[pixel];
      for (size_t channel = 0; channel < 3; ++channel) {
        uint8_t& value = image.pixels[3 * pixel + channel];
        value = static_cast<uint8_t>((value * paper + colour[channel] * (255 - paper)) / 255);
      }
    }
  }
  return image;
}

render::Image ColouredDrawing(const StyledDrawing& drawing, int size) {
  render::Image image = ColouredStrokes(LabelledStrokes(drawing), size);
  const double scale = double(size) / render::kSketchCanvas;
  for (const auto& point : drawing.points) {
    if (!point.is_shown()) continue;
    const int x = static_cast<int>(point.value[0] * scale), y = static_cast<int>(point.value[1] * scale);
    render::FillRectangle(image, y - 1, x - 1, 3, 3, {255, 0, 255});
  }
  return image;
}

}  // namespace daumier::datasets
