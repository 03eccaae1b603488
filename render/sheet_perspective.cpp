#include "render/sheet_perspective.h"

#include "core/error.h"
#include "render/opencv_bridge.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

/// Strip along the sides that RectifySheet cuts off, as a share of the sheet's smaller side.
constexpr double kCutStrip = 0.012;
/// Focal length in the picture's longer sides: limits of an estimate, and what is taken without one.
constexpr double kMinFocal = 0.6, kMaxFocal = 3.0, kUsualFocal = 1.2;
/// Width over height of usual sheets that lie on their side, and how far from them an estimate may be.
constexpr std::array<double, 5> kFormats = {1.0, 11.0 / 8.5, 4.0 / 3.0, 1.41421356237, 1.5};
constexpr double kFormatTolerance = 0.03;

/// Columns are the images of the unit square's two sides and of its corner (0, 0).
Eigen::Matrix3d HomographyOfUnitSquare(const std::array<Vector2d, 4>& quad) {
  const Vector2d d1 = quad[1] - quad[2], d2 = quad[3] - quad[2], sum = quad[0] - quad[1] + quad[2] - quad[3];
  const auto determinant = [](const Vector2d& a, const Vector2d& b) {
    return (Eigen::Matrix2d() << a, b).finished().determinant();
  };
  const double g = determinant(sum, d2) / determinant(d1, d2), h = determinant(d1, sum) / determinant(d1, d2);
  Eigen::Matrix3d homography;
  homography.col(0) << quad[1] - quad[0] + g * quad[1], g;
  homography.col(1) << quad[3] - quad[0] + h * quad[3], h;
  homography.col(2) << quad[0], 1.0;
  return homography;
}

/// The whole sheet seen from above, in pixels, and the strip along its sides that is cut off.
struct SheetSize {
  double width, height, cut;
};

SheetSize SizeOf(const PhotoSheet& sheet, int height, int width) {
  const auto& corners = sheet.corners;
  const double across = std::max((corners[1] - corners[0]).norm(), (corners[2] - corners[3]).norm());
  const double down = std::max((corners[3] - corners[0]).norm(), (corners[2] - corners[1]).norm());
  const double aspect = SheetAspect(sheet, height, width), of_sheet = std::max(across, aspect * down);
  return {of_sheet, of_sheet / aspect, kCutStrip * std::min(of_sheet, of_sheet / aspect)};
}

}  // namespace

double SheetAspect(const PhotoSheet& sheet, int height, int width) {
  Eigen::Matrix3d homography = HomographyOfUnitSquare(sheet.corners);
  const double longer = std::max(height, width);
  homography.row(0) -= 0.5 * width * homography.row(2);
  homography.row(1) -= 0.5 * height * homography.row(2);
  homography.topRows(2) /= longer;
  // Sides of a rectangle are perpendicular: x1 x2 + y1 y2 + f^2 w1 w2 = 0.
  const Eigen::Vector3d u = homography.col(0), v = homography.col(1);
  const double squared = -u.head<2>().dot(v.head<2>()) / (u.z() * v.z());
  const bool is_estimate =
      std::isfinite(squared) && squared >= kMinFocal * kMinFocal && squared <= kMaxFocal * kMaxFocal;
  const double focal = is_estimate ? std::sqrt(squared) : kUsualFocal;
  const Eigen::Vector3d ray(1.0, 1.0, focal);
  const double aspect = u.cwiseProduct(ray).norm() / v.cwiseProduct(ray).norm();

  double nearest = aspect, distance = std::log1p(kFormatTolerance);
  for (const double format : kFormats) {
    for (const double candidate : {format, 1.0 / format}) {
      const double ratio = std::abs(std::log(aspect / candidate));
      if (ratio > distance) continue;
      distance = ratio;
      nearest = candidate;
    }
  }
  return nearest;
}

Eigen::Matrix3d PictureFromRectified(const PhotoSheet& sheet, int height, int width) {
  const SheetSize size = SizeOf(sheet, height, width);
  Eigen::Matrix3d unit_from_rectified;
  unit_from_rectified << 1 / size.width, 0, size.cut / size.width, 0, 1 / size.height, size.cut / size.height, 0, 0, 1;
  return HomographyOfUnitSquare(sheet.corners) * unit_from_rectified;
}

Image RectifySheet(const Image& picture, const PhotoSheet& sheet) {
  DAUMIER_CHECK(!picture.pixels.empty(), "the picture is empty");
  const auto& corners = sheet.corners;
  const auto [width, height, cut] = SizeOf(sheet, picture.height, picture.width);
  std::array<cv::Point2f, 4> from, to;
  for (int i = 0; i < 4; ++i) {
    // OpenCV counts from the centre of the first pixel.
    from[i] = {static_cast<float>(corners[i].x() - 0.5), static_cast<float>(corners[i].y() - 0.5)};
    to[i] = {static_cast<float>((i == 1 || i == 2 ? width : 0.0) - cut - 0.5),
             static_cast<float>((i >= 2 ? height : 0.0) - cut - 0.5)};
  }
  Image rectified(std::max(1, static_cast<int>(std::lround(height - 2.0 * cut))),
                  std::max(1, static_cast<int>(std::lround(width - 2.0 * cut))), picture.channels);
  cv::Mat view = MatView(rectified);
  cv::warpPerspective(MatView(picture), view, cv::getPerspectiveTransform(from.data(), to.data()), view.size(),
                      cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return rectified;
}

}  // namespace daumier::render
