#include "render/strokes.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

struct Point {
  double x, y;
};

/// All pixels within a distance of a segment, in pixels of the picture.
struct Capsule {
  Point from, to;
  double half_width;
  bool antialias;
};

/// Pixels whose centres can lie in [low, high], cut at the picture's border.
struct PixelRange {
  int begin, end;
};
PixelRange CentresWithin(double low, double high, int size) {
  const double limit = size;
  return {static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, limit)),
          static_cast<int>(std::clamp(std::floor(high - 0.5) + 1.0, 0.0, limit))};
}

void DrawCapsule(const Capsule& capsule, Image& image) {
  const auto [from, to, half_width, antialias] = capsule;
  const double reach = antialias ? half_width + 0.5 : half_width;
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double length_squared = dx * dx + dy * dy;
  const double inverse_length_squared = length_squared > 0.0 ? 1.0 / length_squared : 0.0;

  const auto rows = CentresWithin(std::min(from.y, to.y) - reach, std::max(from.y, to.y) + reach, image.height);
  for (int row = rows.begin; row < rows.end; ++row) {
    const double y = row + 0.5;
    // Only the part of the segment that is within reach of this row can cover its pixels.
    double first = 0.0, last = 1.0;
    if (dy != 0.0) {
      const double at_top = (y - reach - from.y) / dy, at_bottom = (y + reach - from.y) / dy;
      first = std::clamp(std::min(at_top, at_bottom), 0.0, 1.0);
      last = std::clamp(std::max(at_top, at_bottom), 0.0, 1.0);
    }
    const double x_first = from.x + first * dx, x_last = from.x + last * dx;
    const auto columns =
        CentresWithin(std::min(x_first, x_last) - reach, std::max(x_first, x_last) + reach, image.width);
    uint8_t* pixels = image.pixels.data() + size_t(row) * image.width;
    for (int column = columns.begin; column < columns.end; ++column) {
      const double px = column + 0.5 - from.x, py = y - from.y;
      const double along = std::clamp((px * dx + py * dy) * inverse_length_squared, 0.0, 1.0);
      const double ex = px - along * dx, ey = py - along * dy;
      const double distance_squared = ex * ex + ey * ey;
      if (distance_squared > reach * reach) continue;
      const double coverage = antialias ? std::min(reach - std::sqrt(distance_squared), 1.0) : 1.0;
      const auto value = static_cast<uint8_t>(255.0 * (1.0 - coverage) + 0.5);
      pixels[column] = std::min(pixels[column], value);
    }
  }
}

}  // namespace

Image RasteriseStrokes(const std::vector<Stroke>& strokes, int size, const StrokeStyle& style) {
  DAUMIER_CHECK(size > 0, "a sketch of {} pixels, expected a positive size", size);
  DAUMIER_CHECK(style.width > 0.0, "strokes have the width {}, expected a positive number", style.width);
  Image image(size, size, 1, 255);
  const double scale = static_cast<double>(size) / kSketchCanvas;
  const double half_width = 0.5 * style.width * scale;
  for (const Stroke& stroke : strokes) {
    Point previous{};
    for (size_t i = 0; i < stroke.points.size(); ++i) {
      const Point point{stroke.points[i][0] * scale, stroke.points[i][1] * scale};
      DAUMIER_CHECK(std::isfinite(point.x) && std::isfinite(point.y), "point {} of a stroke is ({}, {})", i, point.x,
                    point.y);
      if (i > 0 || stroke.points.size() == 1) {
        DrawCapsule({i > 0 ? previous : point, point, half_width, style.antialias}, image);
      }
      previous = point;
    }
  }
  return image;
}

}  // namespace daumier::render
