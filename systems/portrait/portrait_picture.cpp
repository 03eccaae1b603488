#include "systems/portrait/portrait_picture.h"

#include "core/error.h"
#include "core/picture_parts.h"
#include "raster/face_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace daumier::portrait {
fitting::PortraitPose PoseOfCoefficients(std::span<const float> coefficients) {
  DAUMIER_CHECK(coefficients.size() == size_t(faces::kNumCoefficients), "{} coefficients of a portrait, expected {}",
                coefficients.size(), faces::kNumCoefficients);
  return Eigen::Map<const Eigen::Matrix<float, 6, 1>>(coefficients.data() + faces::kPoseSlot.first).cast<double>();
}

FacePainter::FacePainter(const faces::MorphableModel& model)
    : model_(model),
      topology_(
          raster::MakeTopology({model.face_template.triangles.data(), size_t(model.face_template.triangles.size())},
                               model.face_template.num_vertices())) {}

FacePicture FacePainter::Paint(std::span<const float> coefficients) const {
  return Paint(faces::Reconstruct(model_, coefficients), coefficients);
}

FacePicture FacePainter::Paint(const faces::ColouredFace& face, std::span<const float> coefficients) const {
  const fitting::PortraitPose own_pose = PoseOfCoefficients(coefficients);
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const Rows vertices = face.vertices.cast<float>(), albedo = face.albedo;
  std::array<float, raster::kLightBands> light{};
  std::copy_n(coefficients.begin() + faces::kLightSlot.first, raster::kLightBands, light.begin());
  raster::Pose<float> pose{};
  std::copy_n(coefficients.begin() + faces::kPoseSlot.first, 6, pose.begin());
  FacePicture picture{std::vector<float>(size_t(4 * kPortraitSide * kPortraitSide)), {}};
  raster::FacePicture<float> kernel;
  kernel.Forward(topology_, vertices.data(), albedo.data(), light, pose, {}, {}, picture.colours.data());
  const geometry::Points posed_points = fitting::Posed(face.vertices, own_pose);
  const fitting::PicturePoints pixels = fitting::Projected(posed_points);
  for (const int vertex : model_.face_template.annotation.landmarks)
    for (int axis = 0; axis < 2; ++axis) picture.landmarks.push_back(float(pixels(vertex, axis)));
  return picture;
}

std::vector<float> FaceMask(const render::Image& classes) {
  std::array<float, 256> shows{};
  for (const PictureClass c : {PictureClass::kSkin, PictureClass::kBrows, PictureClass::kLips, PictureClass::kEars})
    shows[size_t(c)] = 1;
  std::vector<float> mask(classes.pixels.size());
  std::transform(classes.pixels.begin(), classes.pixels.end(), mask.begin(), [&](uint8_t c) { return shows[c]; });
  return mask;
}

double PhotometricError(const FacePicture& face, const render::Image& crop, std::span<const float> shown) {
  constexpr float kCovered = 0.999F;
  const size_t num_pixels = size_t(kPortraitSide) * kPortraitSide;
  DAUMIER_CHECK(crop.pixels.size() == 3 * num_pixels && shown.size() == num_pixels,
                "a crop of {} numbers with a mask of {}, expected {} and {}", crop.pixels.size(), shown.size(),
                3 * num_pixels, num_pixels);
  double sum = 0, count = 0;
  for (size_t i = 0; i < num_pixels; ++i) {
    if (shown[i] < 0.5F || face.colours[4 * i + 3] < kCovered) continue;
    for (size_t c = 0; c < 3; ++c)
      sum += std::abs(std::clamp(face.colours[4 * i + c], 0.0F, 1.0F) - float(crop.pixels[3 * i + c]) / 255.0F);
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

render::Image OverlayFace(const render::Image& crop, const FacePicture& face, double share) {
  render::Image picture = crop;
  for (size_t i = 0; i < picture.pixels.size() / 3; ++i) {
    const double coverage = share * face.colours[4 * i + 3];
    for (size_t c = 0; c < 3; ++c) {
      const double colour = std::clamp<double>(face.colours[4 * i + c], 0, 1) * 255;
      picture.pixels[3 * i + c] =
          uint8_t(std::clamp(share * colour + (1 - coverage) * picture.pixels[3 * i + c] + 0.5, 0.0, 255.0));
    }
  }
  return picture;
}

render::Image DotsOver(const render::Image& picture, std::span<const float> landmarks, const render::Rgb& colour) {
  constexpr double kRadius = 1.5;
  render::Image dotted = picture;
  for (size_t n = 0; n + 1 < landmarks.size(); n += 2) {
    const double x = landmarks[n], y = landmarks[n + 1];
    if (!(std::abs(x) < 1e5 && std::abs(y) < 1e5)) continue;
    for (int row = int(y - kRadius); row <= int(y + kRadius); ++row) {
      for (int column = int(x - kRadius); column <= int(x + kRadius); ++column) {
        if (row < 0 || column < 0 || row >= dotted.height || column >= dotted.width) continue;
        if (std::hypot(column + 0.5 - x, row + 0.5 - y) > kRadius) continue;
        for (int c = 0; c < 3; ++c) dotted.at(row, column, c) = colour[size_t(c)];
      }
    }
  }
  return dotted;
}

}  // namespace daumier::portrait
