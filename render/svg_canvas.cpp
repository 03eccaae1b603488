#include "render/svg_canvas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kCanvasSide = 1024.0, kLeastCanvasSide = 128.0;
/// Pixels that all shapes together may paint; more make the canvas coarser.
constexpr double kMaxPainted = 3e8;
/// Bits of a pixel's fraction in OpenCV's coordinates.
constexpr int kCanvasShift = 4;
/// Masks of clips that are kept: neighbours have the same ones.
constexpr size_t kMaxMasks = 8;

AlignedBox2d BoxOfShape(const SvgShape& shape) {
  AlignedBox2d box;
  for (const auto& polyline : shape.polylines)
    for (const auto& point : polyline.points) box.extend(point);
  return box;
}

cv::Scalar ScalarOf(const Vector3d& rgb) {
  return {255.0 * rgb.x(), 255.0 * rgb.y(), 255.0 * rgb.z()};
}

Vector3d ColorOfPixel(const cv::Vec3b& pixel) {
  return Vector3d(pixel[0], pixel[1], pixel[2]) / 255.0;
}

}  // namespace

struct SvgCanvas::Pixels {
  cv::Mat color;   ///< CV_8UC3.
  cv::Mat hidden;  ///< CV_32S: the last shape that hides what lies below; -1 where there is none.
  std::map<const SvgClip*, cv::Mat> clips;
  Vector2d corner;
  double step;

  cv::Point PixelOf(const Vector2d& point) const {
    const Vector2d pixel = (point - corner) / step;
    // The corners of the canvas are far from these limits.
    const auto fixed = [](double value) {
      return static_cast<int>(std::lround(std::clamp(value - 0.5, -8192.0, 16384.0) * (1 << kCanvasShift)));
    };
    return {fixed(pixel.x()), fixed(pixel.y())};
  }

  std::vector<cv::Point> PixelsOf(const SvgPolyline& polyline) const {
    std::vector<cv::Point> pixels;
    pixels.reserve(polyline.points.size());
    for (const auto& point : polyline.points) pixels.push_back(PixelOf(point));
    return pixels;
  }

  /// The pixels that a box touches, with a margin.
  cv::Rect RectangleOf(const AlignedBox2d& box, double margin) const {
    if (box.isEmpty()) return {};
    const Vector2d low = (box.min() - corner) / step, high = (box.max() - corner) / step;
    const auto limited = [&](double value) { return static_cast<int>(std::clamp(value, -8192.0, 16384.0)); };
    const cv::Point from(limited(std::floor(low.x() - margin)), limited(std::floor(low.y() - margin)));
    const cv::Point to(limited(std::ceil(high.x() + margin)) + 1, limited(std::ceil(high.y() + margin)) + 1);
    return cv::Rect(from, to) & cv::Rect(0, 0, color.cols, color.rows);
  }

  /// 255 inside an area, within a rectangle, and where its outline passes: an area thinner than a pixel still hides what
  /// lies below, which FillArea, by the centres of pixels, would leave seen.
  cv::Mat MaskOfArea(const std::vector<SvgPolyline>& rings, FillRule rule, const cv::Rect& rectangle) const {
    cv::Mat mask = cv::Mat::zeros(rectangle.size(), CV_8U);
    const cv::Point offset(-rectangle.x * (1 << kCanvasShift), -rectangle.y * (1 << kCanvasShift));
    std::vector<std::vector<cv::Point>> contours;
    for (const auto& ring : rings) {
      if (ring.points.size() < 3) continue;
      contours.push_back(PixelsOf(ring));
      for (cv::Point& pixel : contours.back()) pixel += offset;
    }
    if (rule == FillRule::kEvenOdd || contours.size() == 1) {
      if (!contours.empty()) cv::fillPoly(mask, contours, cv::Scalar(255), cv::LINE_8, kCanvasShift);
      return mask;
    }
    cv::Mat winding = cv::Mat::zeros(rectangle.size(), CV_16S), of_ring(rectangle.size(), CV_8U);
    for (const auto& contour : contours) {
      std::vector<cv::Point2f> corners(contour.begin(), contour.end());
      const cv::Scalar sign(cv::contourArea(corners, true) >= 0 ? 1 : -1);
      of_ring.setTo(0);
      cv::fillPoly(of_ring, std::vector{contour}, cv::Scalar(255), cv::LINE_8, kCanvasShift);
      cv::add(winding, sign, winding, of_ring);
    }
    mask.setTo(255, winding != 0);
    return mask;
  }

  const cv::Mat& MaskOfClip(const SvgClip& clip) {
    const auto found = clips.find(&clip);
    if (found != clips.end()) return found->second;
    if (clips.size() >= kMaxMasks) clips.clear();
    cv::Mat mask = cv::Mat::zeros(color.size(), CV_8U);
    for (const auto& area : clip.areas())
      mask |= MaskOfArea(area.rings, area.rule, cv::Rect(0, 0, color.cols, color.rows));
    return clips[&clip] = mask;
  }

  void ApplyClips(const SvgShape& shape, const cv::Rect& rectangle, cv::Mat& mask) {
    for (const auto& clip : shape.clips) mask &= MaskOfClip(*clip)(rectangle);
  }
};

double PaintContrast(const SvgColor& paint, const Vector3d& below) {
  return paint.alpha * (paint.rgb - below).cwiseAbs().maxCoeff();
}

double SvgCanvas::SideFor(const AlignedBox2d& box, const std::vector<SvgShape>& shapes) {
  double shares = 0.0;
  for (const auto& shape : shapes) {
    const AlignedBox2d part = BoxOfShape(shape).intersection(box);
    if (!part.isEmpty()) shares += part.volume() / std::max(box.volume(), 1e-12);
  }
  return std::clamp(std::sqrt(kMaxPainted / std::max(shares, 1e-12)), kLeastCanvasSide, kCanvasSide);
}

SvgCanvas::SvgCanvas(const AlignedBox2d& box, const SvgColor& paper, double side)
    : paper_(paper.rgb), corner_(box.min()), pixels_(std::make_unique<Pixels>()) {
  step_ = std::max(box.sizes().maxCoeff(), 1e-9) / side;
  const auto pixels = [&](double length) {
    return static_cast<int>(std::clamp(std::ceil(length / step_), 1.0, side + 1));
  };
  const cv::Size size(pixels(box.sizes().x()), pixels(box.sizes().y()));
  pixels_->color = cv::Mat(size, CV_8UC3, ScalarOf(paper_));
  pixels_->hidden = cv::Mat(size, CV_32S, cv::Scalar(-1));
  pixels_->corner = corner_;
  pixels_->step = step_;
}

SvgCanvas::~SvgCanvas() = default;

Vector3d SvgCanvas::ColorAt(const Vector2d& point) const {
  const Vector2d pixel = (point - corner_) / step_;
  if (pixel.minCoeff() < 0.0 || pixel.x() >= pixels_->color.cols || pixel.y() >= pixels_->color.rows) return paper_;
  return ColorOfPixel(pixels_->color.at<cv::Vec3b>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x())));
}

bool SvgCanvas::IsHidden(const Vector2d& point, int shape) const {
  const Vector2d pixel = (point - corner_) / step_;
  if (pixel.minCoeff() < 0.0 || pixel.x() >= pixels_->color.cols || pixel.y() >= pixels_->color.rows) return false;
  return pixels_->hidden.at<int>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x())) > shape;
}

void SvgCanvas::PaintArea(const SvgShape& shape, int index) {
  const cv::Rect rectangle = pixels_->RectangleOf(BoxOfShape(shape), 1.0);
  if (rectangle.empty()) return;
  cv::Mat mask = pixels_->MaskOfArea(shape.polylines, shape.fill_rule, rectangle);
  pixels_->ApplyClips(shape, rectangle, mask);
  const SvgColor& paint = *shape.fill;
  const cv::Scalar color = ScalarOf(paint.rgb);
  cv::Mat below = pixels_->color(rectangle);
  if (paint.alpha >= 1.0) {
    below.setTo(color, mask);
  } else {
    cv::Mat blended;
    below.convertTo(blended, -1, 1.0 - paint.alpha);
    cv::add(blended, color * paint.alpha, blended);
    blended.copyTo(below, mask);
  }
  if (paint.alpha >= 0.5) pixels_->hidden(rectangle).setTo(index, mask);
}

void SvgCanvas::Erase(const SvgShape& shape, int index, double contrast) {
  const double width = std::clamp(shape.stroke_width / step_, 1.0, 8192.0);
  const cv::Rect rectangle = pixels_->RectangleOf(BoxOfShape(shape), 0.5 * width + 1.0);
  if (rectangle.empty()) return;
  cv::Mat mask = cv::Mat::zeros(rectangle.size(), CV_8U);
  const cv::Point offset(-rectangle.x * (1 << kCanvasShift), -rectangle.y * (1 << kCanvasShift));
  for (const auto& polyline : shape.polylines) {
    auto contour = pixels_->PixelsOf(polyline);
    for (cv::Point& pixel : contour) pixel += offset;
    cv::polylines(mask, contour, false, cv::Scalar(255), static_cast<int>(std::lround(width)), cv::LINE_8,
                  kCanvasShift);
  }
  pixels_->ApplyClips(shape, rectangle, mask);
  for (int row = 0; row < mask.rows; ++row) {
    for (int column = 0; column < mask.cols; ++column) {
      if (mask.at<uint8_t>(row, column) == 0) continue;
      const auto& below = pixels_->color.at<cv::Vec3b>(rectangle.y + row, rectangle.x + column);
      if (PaintContrast(*shape.stroke, ColorOfPixel(below)) < contrast)
        pixels_->hidden.at<int>(rectangle.y + row, rectangle.x + column) = index;
    }
  }
}

}  // namespace daumier::render
