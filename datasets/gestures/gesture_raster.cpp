#include "datasets/gestures/gesture_raster.h"

#include "core/error.h"
#include "render/strokes.h"

#include <algorithm>

namespace daumier::datasets {

void RasteriseGesture(const Polyline& stroke, const GestureRaster& raster, std::span<float> picture) {
  DAUMIER_CHECK(picture.size() == size_t(raster.side) * size_t(raster.side), "a picture of {} pixels, expected {} x {}",
                picture.size(), raster.side, raster.side);
  DAUMIER_CHECK(stroke.size() >= 2, "a gesture of {} points (expected a stroke of at least 2)", stroke.size());
  for (size_t i = 0; i < stroke.size(); ++i)
    DAUMIER_CHECK(stroke[i].allFinite(), "point {} of a gesture is ({}, {}) (expected finite numbers)", i,
                  stroke[i].x(), stroke[i].y());
  const Eigen::AlignedBox2d box = BoxOf(stroke);
  const double extent = box.sizes().maxCoeff();
  DAUMIER_CHECK(extent > 0, "all {} points of a gesture are the same (expected a stroke that moves)", stroke.size());
  constexpr double kCanvas = render::kSketchCanvas;
  const double scale = (1 - 2 * kRasterMargin) * kCanvas / extent;
  DAUMIER_CHECK(std::isfinite(scale) && std::isfinite(extent), "a gesture of the extent {} (expected pixels)", extent);
  render::Stroke drawn;
  drawn.points.reserve(stroke.size());
  for (const Eigen::Vector2d& point : stroke) {
    const Eigen::Vector2d at = scale * (point - box.center()) + Eigen::Vector2d::Constant(0.5 * kCanvas);
    drawn.points.push_back({float(at.x()), float(at.y())});
  }
  const render::Image image = render::RasteriseStrokes(
      {drawn}, raster.side, {.width = raster.width * kCanvas / raster.side, .antialias = !raster.binary});
  std::ranges::transform(image.pixels, picture.begin(), [](uint8_t grey) { return float(255 - grey) / 255.0f; });
}

}  // namespace daumier::datasets
