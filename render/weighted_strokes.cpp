#include "render/weighted_strokes.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace daumier::render {
namespace {

std::array<float, 2> Between(const std::array<float, 2>& a, const std::array<float, 2>& b, double share) {
  return {float(a[0] + share * (b[0] - a[0])), float(a[1] + share * (b[1] - a[1]))};
}

void CheckWidths(const WeightedStroke& stroke) {
  DAUMIER_CHECK(stroke.widths.empty() || stroke.widths.size() == stroke.points.size(), "{} widths of {} points",
                stroke.widths.size(), stroke.points.size());
  for (const float width : stroke.widths)
    DAUMIER_CHECK(std::isfinite(width) && width >= 0, "a stroke has the width {}, expected 0 or a positive number",
                  width);
}

}  // namespace

std::vector<StrokePart> PartsByWidth(const WeightedStroke& stroke) {
  CheckWidths(stroke);
  const auto width_at = [&](size_t i) {
    return !stroke.widths.empty() && stroke.widths[i] > 0 ? double(stroke.widths[i]) : StrokeStyle{}.width;
  };
  if (stroke.points.empty()) return {};
  const bool is_even = std::ranges::all_of(stroke.widths, [&](float width) { return width == stroke.widths.front(); });
  if (is_even) return {{stroke, width_at(0)}};
  std::vector<StrokePart> parts;
  for (size_t i = 1; i < stroke.points.size(); ++i) {
    const double from = width_at(i - 1), to = width_at(i);
    const int count =
        std::clamp(int(std::ceil(std::min<double>(kMostPartsOfSegment, std::abs(to - from) / kWidthStep))), 1,
                   kMostPartsOfSegment);
    for (int k = 1; k <= count; ++k) {
      const double middle = from + (to - from) * (k - 0.5) / count;
      const double width = std::max(1.0, std::round(middle / kWidthStep)) * kWidthStep;
      if (parts.empty() || parts.back().width != width) {
        const std::array<float, 2> start = parts.empty() ? stroke.points[0] : parts.back().stroke.points.back();
        parts.push_back({{stroke.kind, {start}}, width});
      }
      parts.back().stroke.points.push_back(Between(stroke.points[i - 1], stroke.points[i], double(k) / count));
    }
  }
  return parts;
}

std::vector<WeightedStroke> MapWeighted(std::vector<WeightedStroke> strokes, const Placement& placement) {
  std::vector<Stroke> mapped = MapToCanvas({strokes.begin(), strokes.end()}, placement);
  for (size_t i = 0; i < strokes.size(); ++i) {
    strokes[i].points = std::move(mapped[i].points);
    for (float& width : strokes[i].widths) width *= float(placement.scale);
  }
  return strokes;
}

Image RasteriseWeighted(const std::vector<WeightedStroke>& strokes, int size) {
  std::map<double, std::vector<Stroke>> by_width;
  for (const WeightedStroke& stroke : strokes)
    for (StrokePart& part : PartsByWidth(stroke)) by_width[part.width].push_back(std::move(part.stroke));
  Image image = RasteriseStrokes({}, size);
  for (const auto& [width, parts] : by_width) {
    const Image of_width = RasteriseStrokes(parts, size, {.width = width});
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::min(image.pixels[i], of_width.pixels[i]);
  }
  return image;
}

}  // namespace daumier::render
