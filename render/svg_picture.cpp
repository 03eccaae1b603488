#include "render/svg_picture.h"

#include "core/error.h"
#include "core/files.h"
#include "render/filled_area.h"
#include "render/opencv_bridge.h"
#include "render/svg_scene.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

constexpr double kPaintTolerance = 1e-3;  // Of the longer side.
constexpr int kSubpixelBits = 4;

/// Lays a colour over the pixels that a mask marks in some rows, and takes their marks away.
void LayOver(const SvgColor& colour, const cv::Range& rows, Image& mask, Image& picture) {
  for (size_t i = size_t(rows.start) * mask.width; i < size_t(rows.end) * mask.width; ++i) {
    if (mask.pixels[i] == 0) continue;
    mask.pixels[i] = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double below = picture.pixels[3 * i + c];
      picture.pixels[3 * i + c] =
          uint8_t(std::lround(below + colour.alpha * (255 * colour.rgb[Eigen::Index(c)] - below)));
    }
  }
}

/// The rows that a shape may mark.
cv::Range RowsOf(const SvgShape& shape, double scale, int height) {
  double top = height, bottom = 0;
  for (const SvgPolyline& polyline : shape.polylines) {
    for (const Eigen::Vector2d& p : polyline.points) {
      top = std::min(top, scale * p.y());
      bottom = std::max(bottom, scale * p.y());
    }
  }
  const double border = scale * shape.stroke_width + 2;
  const int first = int(std::clamp<double>(top - border, 0, height));
  return {first, int(std::clamp<double>(bottom + border, first, height))};
}

void MarkArea(const SvgShape& shape, double scale, Image& mask) {
  FilledArea area{.outlines = {}, .rule = shape.fill_rule};
  for (const SvgPolyline& polyline : shape.polylines) area.outlines.push_back(polyline.points);
  FillArea(area, {.scale = scale}, 1, mask);
}

void MarkStroke(const SvgShape& shape, double scale, Image& mask) {
  const int width = std::clamp(int(std::lround(scale * shape.stroke_width)), 1, mask.width);
  cv::Mat view = MatView(mask);
  for (const SvgPolyline& polyline : shape.polylines) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& p : polyline.points) {
      const Eigen::Vector2d in_picture =
          ((scale * p).array() - 0.5).cwiseMax(-1e5).cwiseMin(1e5) * (1 << kSubpixelBits);
      points.emplace_back(int(std::lround(in_picture.x())), int(std::lround(in_picture.y())));
    }
    cv::polylines(view, points, /*isClosed=*/false, cv::Scalar(1), width, cv::LINE_8, kSubpixelBits);
  }
}

Eigen::Vector2d SizeOf(const SvgScene& scene) {
  if (scene.width > 0 && scene.height > 0) return {scene.width, scene.height};
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  for (const SvgShape& shape : scene.shapes)
    for (const SvgPolyline& polyline : shape.polylines)
      for (const Eigen::Vector2d& p : polyline.points) size = size.cwiseMax(p);
  DAUMIER_CHECK(size.minCoeff() > 0, "{}: states no size and has no shapes", scene.file);
  return size;
}

}  // namespace

Image PaintSvg(const std::filesystem::path& file, int side, double* scale) {
  const SvgDocument document(file.string(), ReadFile(file));
  const SvgScene scene = ReadSvgScene(document, {}, kPaintTolerance);
  const Eigen::Vector2d size = SizeOf(scene);
  const double factor = side / size.maxCoeff();
  if (scale != nullptr) *scale = factor;
  const auto pixels = [&](double length) { return std::max(1, int(std::lround(factor * length))); };
  Image picture(pixels(size.y()), pixels(size.x()), 3);
  Image mask(picture.height, picture.width, 1, 1);
  const SvgColor white{Eigen::Vector3d::Ones()};
  LayOver(scene.background.value_or(white), {0, picture.height}, mask, picture);
  for (const SvgShape& shape : scene.shapes) {
    const cv::Range rows = RowsOf(shape, factor, picture.height);
    if (shape.fill) {
      MarkArea(shape, factor, mask);
      LayOver(*shape.fill, rows, mask, picture);
    }
    if (shape.stroke && shape.stroke_width > 0) {
      MarkStroke(shape, factor, mask);
      LayOver(*shape.stroke, rows, mask, picture);
    }
  }
  return picture;
}

}  // namespace daumier::render
