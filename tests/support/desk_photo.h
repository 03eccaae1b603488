#pragma once
#include "core/random.h"
#include "render/image.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

/// Photographs of a drawing on a desk whose homography is known, for tests and for bench/desk_photos.cpp.
namespace daumier::testing {

enum class Desk { kDark, kGrey, kWood };

struct DeskPhotoOptions {
  Desk desk = Desk::kDark;
  double border = 0.1;  ///< Share of the picture's width and height between its border and the sheet, on each side.
  double tilt = 0.0;    ///< Degrees by which the sheet is turned in its plane, and by which the camera is inclined.
  double noise = 3.0;   ///< Standard deviation of a pixel, of 255.
  uint64_t seed = 1;
};

/// Distance of the camera from the middle of the sheet, in the sheet's longer side.
inline constexpr double kCameraDistance = 1.6;

/// From the drawing's pixels to the photograph's, up to a factor: p = H (x, y, 1), and the photograph's size.
struct DeskCamera {
  Eigen::Matrix3d photo_from_drawing;
  int height = 0, width = 0;

  Eigen::Vector2d Project(double x, double y) const {
    return (photo_from_drawing * Eigen::Vector3d(x, y, 1)).hnormalized();
  }
};

/// A pinhole camera whose middle ray meets the middle of the sheet. One pixel of the drawing's middle is one pixel of
/// the photograph.
inline DeskCamera CameraOverDesk(int height, int width, const DeskPhotoOptions& options) {
  const double angle = options.tilt * std::numbers::pi / 180.0;
  const double distance = kCameraDistance * std::max(height, width);
  const Eigen::Matrix3d rotation =
      (Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(0.5 * angle, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
  Eigen::Matrix3d camera;
  camera.col(0) = rotation.col(0);
  camera.col(1) = rotation.col(1);
  camera.col(2) = -0.5 * width * rotation.col(0) - 0.5 * height * rotation.col(1) + Eigen::Vector3d(0, 0, distance);
  camera.topRows(2) *= distance;

  DeskCamera result{camera};
  Eigen::AlignedBox2d sheet;
  for (const double x : {0.0, double(width)}) {
    for (const double y : {0.0, double(height)}) sheet.extend(result.Project(x, y));
  }
  const Eigen::Vector2d size = sheet.sizes() / (1.0 - 2.0 * options.border);
  Eigen::Matrix3d shift = Eigen::Matrix3d::Identity();
  shift.topRightCorner<2, 1>() = 0.5 * size - sheet.center();
  result.photo_from_drawing = shift * camera;
  result.width = static_cast<int>(std::lround(size.x()));
  result.height = static_cast<int>(std::lround(size.y()));
  return result;
}

/// Colour of the desk at a place, in [0, 255]. Wood has a grain of stripes along x.
inline Eigen::Vector3d DeskColour(Desk desk, double x, double y, double side) {
  if (desk == Desk::kDark) return {58, 56, 55};
  if (desk == Desk::kGrey) return {132, 130, 126};
  const double u = x / side, v = y / side;
  const double wave = std::sin(90.0 * v + 3.0 * std::sin(5.0 * u) + std::sin(17.0 * u + 23.0 * v)) +
                      0.6 * std::sin(310.0 * v + 4.0 * std::sin(7.0 * u));
  return Eigen::Vector3d(158, 116, 78) + 16.0 * wave * Eigen::Vector3d(1.0, 0.9, 0.7);
}

/// Brightness of the drawing, 0 to 255, between pixel centres.
inline double SampleDrawing(const render::Image& drawing, double x, double y) {
  const auto pixel = [&](int row, int column) {
    row = std::clamp(row, 0, drawing.height - 1);
    column = std::clamp(column, 0, drawing.width - 1);
    double sum = 0.0;
    for (int channel = 0; channel < drawing.channels; ++channel) sum += drawing.at(row, column, channel);
    return sum / drawing.channels;
  };
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5), s = x - 0.5 - left, t = y - 0.5 - top;
  const int row = static_cast<int>(top), column = static_cast<int>(left);
  return (1 - t) * ((1 - s) * pixel(row, column) + s * pixel(row, column + 1)) +
         t * ((1 - s) * pixel(row + 1, column) + s * pixel(row + 1, column + 1));
}

/// The drawing as the print of a sheet on a desk, as a telephone's camera would see it: RGB, light that falls from the
/// left to the right, grain of the sensor. The same options give the same picture.
inline render::Image DeskPhoto(const render::Image& drawing, const DeskPhotoOptions& options) {
  constexpr int kSamples = 3;
  const DeskCamera camera = CameraOverDesk(drawing.height, drawing.width, options);
  const Eigen::Matrix3d drawing_from_photo = camera.photo_from_drawing.inverse();
  const Eigen::Vector3d paper(222, 220, 214);
  render::Image photo(camera.height, camera.width, 3);
  Rng rng(options.seed);
  for (int row = 0; row < photo.height; ++row) {
    for (int column = 0; column < photo.width; ++column) {
      Eigen::Vector3d colour = Eigen::Vector3d::Zero();
      for (int sample = 0; sample < kSamples * kSamples; ++sample) {
        const double x = column + (sample % kSamples + 0.5) / kSamples, y = row + (sample / kSamples + 0.5) / kSamples;
        const Eigen::Vector2d on_sheet = (drawing_from_photo * Eigen::Vector3d(x, y, 1)).hnormalized();
        const bool is_sheet =
            on_sheet.x() >= 0 && on_sheet.x() <= drawing.width && on_sheet.y() >= 0 && on_sheet.y() <= drawing.height;
        colour += is_sheet ? Eigen::Vector3d(Eigen::Vector3d::Constant(30) +
                                             (paper.array() - 30).matrix() *
                                                 (SampleDrawing(drawing, on_sheet.x(), on_sheet.y()) / 255.0))
                           : DeskColour(options.desk, x, y, std::max(photo.width, photo.height));
      }
      const double light = 1.05 - 0.15 * column / photo.width;
      colour *= light / (kSamples * kSamples);
      const double grain = options.noise * rng.Normal();
      for (int channel = 0; channel < 3; ++channel) {
        photo.at(row, column, channel) =
            static_cast<uint8_t>(std::lround(std::clamp(colour[channel] + grain, 0.0, 255.0)));
      }
    }
  }
  return photo;
}

}  // namespace daumier::testing
