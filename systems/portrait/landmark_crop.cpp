#include "systems/portrait/landmark_crop.h"

#include "core/error.h"
#include "render/draw.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

constexpr double kFinestRatio = 1.4;  // Pixels of the level to one of the crop.
constexpr int kLeastSide = 16;

render::Image Halved(const render::Image& image) {
  render::Image half(image.height / 2, image.width / 2, 3);
  for (int row = 0; row < half.height; ++row) {
    const uint8_t* const upper = &image.pixels[size_t(2 * row) * size_t(image.width) * 3];
    const uint8_t* const lower = upper + size_t(image.width) * 3;
    uint8_t* const to = &half.pixels[size_t(row) * size_t(half.width) * 3];
    for (int column = 0; column < half.width; ++column)
      for (int k = 0; k < 3; ++k) {
        const int at = 6 * column + k;
        to[3 * column + k] = uint8_t((upper[at] + upper[at + 3] + lower[at] + lower[at + 3] + 2) / 4);
      }
  }
  return half;
}

std::array<int, 68> MakeMirroredLandmarks() {
  std::array<int, 68> order = {};
  const auto exchange = [&](int a, int b) { order[size_t(a)] = b, order[size_t(b)] = a; };
  for (int i = 0; i < 68; ++i) order[size_t(i)] = i;
  for (int i = 0; i < 8; ++i) exchange(i, 16 - i);       // Jaw.
  for (int i = 0; i < 5; ++i) exchange(17 + i, 26 - i);  // Brows.
  for (int i = 0; i < 2; ++i) exchange(31 + i, 35 - i);  // Nose.
  for (int i = 0; i < 4; ++i) exchange(36 + i, 45 - i);  // Upper lids.
  exchange(40, 47), exchange(41, 46);                    // Lower lids.
  for (int i = 0; i < 3; ++i) exchange(48 + i, 54 - i);  // Outer lips.
  exchange(59, 55), exchange(58, 56), exchange(60, 64), exchange(61, 63), exchange(67, 65);
  return order;
}

}  // namespace

Box BoxOf(std::span<const float> points) {
  DAUMIER_CHECK(points.size() >= 2, "a box needs a point");
  Box box{points[0], points[1], points[0], points[1]};
  for (size_t i = 0; i + 1 < points.size(); i += 2) {
    box.left = std::min(box.left, double(points[i]));
    box.right = std::max(box.right, double(points[i]));
    box.top = std::min(box.top, double(points[i + 1]));
    box.bottom = std::max(box.bottom, double(points[i + 1]));
  }
  return box;
}

double Overlap(const Box& a, const Box& b) {
  const double width = std::min(a.right, b.right) - std::max(a.left, b.left),
               height = std::min(a.bottom, b.bottom) - std::max(a.top, b.top);
  if (width <= 0 || height <= 0) return 0;
  return width * height / (a.area() + b.area() - width * height);
}

Eigen::Matrix2d CropFrame::picture_from_crop() const {
  const double c = scale() * std::cos(turn), s = scale() * std::sin(turn), m = mirrored ? -1 : 1;
  Eigen::Matrix2d matrix;
  matrix << m * c, -s, m * s, c;
  return matrix * Eigen::Vector2d(std::exp(0.5 * stretch), std::exp(-0.5 * stretch)).asDiagonal();
}

Eigen::Affine2d CropFrame::crop_from_picture() const {
  const Eigen::Matrix2d linear = picture_from_crop().inverse();
  return Eigen::Translation2d(Eigen::Vector2d::Constant(0.5 * size) - linear * centre) * linear;
}

Eigen::Vector2d CropFrame::ToPicture(const Eigen::Vector2d& p_crop) const {
  return centre + picture_from_crop() * (p_crop - Eigen::Vector2d::Constant(0.5 * size));
}

Eigen::Vector2d CropFrame::ToCrop(const Eigen::Vector2d& p_picture) const {
  return crop_from_picture() * p_picture;
}

PicturePyramid::PicturePyramid(const render::Image& picture) {
  DAUMIER_CHECK(picture.height > 0 && picture.width > 0, "the picture is {} x {}, expected at least one pixel",
                picture.height, picture.width);
  levels_.push_back(picture.channels == 3 ? picture : render::ToRgb(picture));
  while (std::min(levels_.back().height, levels_.back().width) >= 2 * kLeastSide)
    levels_.push_back(Halved(levels_.back()));
}

void SampleCrop(const PicturePyramid& picture, const CropFrame& frame, const Outside& outside, std::span<float> crop,
                std::span<const float> moved) {
  const auto size = size_t(frame.size);
  DAUMIER_CHECK(frame.size > 0 && crop.size() == 3 * size * size && (moved.empty() || moved.size() == 2 * size * size),
                "a crop of side {} has {} numbers and {} of a field", frame.size, crop.size(), moved.size());
  int level = 0;
  while (level + 1 < picture.num_levels() && frame.scale() > kFinestRatio * (1 << level)) ++level;
  const render::Image& image = picture.level(level);
  const double shrunk = 1.0 / (1 << level);
  const Eigen::Matrix2d step = shrunk * frame.picture_from_crop();
  const Eigen::Vector2d first = shrunk * frame.ToPicture({0.5, 0.5}) - Eigen::Vector2d::Constant(0.5);
  const auto last_x = float(image.width - 1), last_y = float(image.height - 1);
  for (size_t row = 0; row < size; ++row)
    for (size_t column = 0; column < size; ++column) {
      const size_t pixel = row * size + column;
      const double u0 = double(column) + (moved.empty() ? 0 : moved[pixel]),
                   v0 = double(row) + (moved.empty() ? 0 : moved[size * size + pixel]);
      const auto x = float(first.x() + step(0, 0) * u0 + step(0, 1) * v0),
                 y = float(first.y() + step(1, 0) * u0 + step(1, 1) * v0);
      float* const to = &crop[pixel];
      if (!outside.continued && (x < -0.5f || y < -0.5f || x > last_x + 0.5f || y > last_y + 0.5f)) {
        for (size_t k = 0; k < 3; ++k) to[k * size * size] = outside.colour[k];
        continue;
      }
      const float cx = std::clamp(x, 0.0f, last_x), cy = std::clamp(y, 0.0f, last_y);
      const int c0 = int(cx), r0 = int(cy), c1 = std::min(c0 + 1, image.width - 1),
                r1 = std::min(r0 + 1, image.height - 1);
      const float u = (cx - float(c0)) * (1 / 255.0f), v = cy - float(r0), w = 1 / 255.0f - u;
      const uint8_t* const upper = &image.pixels[size_t(r0) * size_t(image.width) * 3];
      const uint8_t* const lower = &image.pixels[size_t(r1) * size_t(image.width) * 3];
      for (size_t k = 0; k < 3; ++k) {
        const float above = w * upper[3 * size_t(c0) + k] + u * upper[3 * size_t(c1) + k];
        const float below = w * lower[3 * size_t(c0) + k] + u * lower[3 * size_t(c1) + k];
        to[k * size * size] = std::clamp(above + v * (below - above), 0.0f, 1.0f);
      }
    }
}

std::vector<float> SampleCrop(const PicturePyramid& picture, const CropFrame& frame, const Outside& outside) {
  std::vector<float> crop(3 * size_t(frame.size) * size_t(frame.size));
  SampleCrop(picture, frame, outside, crop);
  return crop;
}

std::vector<int64_t> SampleLabels(const render::Image& mask, const CropFrame& frame, int cells, int64_t none,
                                  std::span<const float> moved) {
  DAUMIER_CHECK(mask.channels == 1, "a mask of classes has {} channels, expected 1", mask.channels);
  std::vector<int64_t> labels(size_t(cells) * size_t(cells), none);
  const double cell = double(frame.size) / cells;
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const size_t pixel = size_t(row) * size_t(cells) + size_t(column);
      Eigen::Vector2d in_crop((column + 0.5) * cell, (row + 0.5) * cell);
      if (!moved.empty()) in_crop += Eigen::Vector2d(moved[pixel], moved[moved.size() / 2 + pixel]);
      const Eigen::Vector2d at = frame.ToPicture(in_crop);
      const double x = std::floor(at.x()), y = std::floor(at.y());
      if (x < 0 || y < 0 || x >= mask.width || y >= mask.height) continue;
      labels[pixel] = mask.at(int(y), int(x));
    }
  return labels;
}

CropFrame FrameOfBox(const Box& box, int size) {
  return {.centre = box.centre(), .side = kCropSide * box.side(), .size = size};
}

const std::array<int, 68>& MirroredLandmarks() {
  static const std::array<int, 68> order = MakeMirroredLandmarks();
  return order;
}

}  // namespace daumier::portrait
