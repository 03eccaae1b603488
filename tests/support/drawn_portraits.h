#pragma once
#include "core/random.h"
#include "systems/portrait/landmark_sample.h"

#include <Eigen/Core>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace daumier::testing {

/// A face of ellipses and lines in a 224 x 224 picture, whose landmarks and mask are known by construction. Sample i is a
/// function of i alone: place, size, turn, colours, and how far eyes and mouth are open.
class DrawnPortraits : public portrait::LandmarkSource {
 public:
  explicit DrawnPortraits(int count) : count_(count) {}

  int size() const override { return count_; }
  int person(int i) const override { return i / 2; }
  portrait::LandmarkSample Get(int i) const override;

 private:
  int count_;
};

namespace drawn {

using Point = Eigen::Vector2d;
using Colour = std::array<double, 3>;

/// Frame of a face: u to the right and v down in units of half of the face's width.
struct Face {
  Point centre;
  double unit, turn;
  Point At(double u, double v) const {
    const double c = std::cos(turn), s = std::sin(turn);
    return centre + unit * Point(c * u - s * v, s * u + c * v);
  }
  Point Inverse(const Point& p) const {
    const double c = std::cos(turn), s = std::sin(turn);
    const Point d = (p - centre) / unit;
    return {c * d.x() + s * d.y(), c * d.y() - s * d.x()};
  }
};

inline bool InEllipse(const Point& p, double u, double v, double a, double b) {
  return (p.x() - u) * (p.x() - u) / (a * a) + (p.y() - v) * (p.y() - v) / (b * b) < 1;
}

}  // namespace drawn

inline portrait::LandmarkSample DrawnPortraits::Get(int i) const {
  using drawn::Point;
  Rng rng = Stream(7, "drawn portraits", uint64_t(i));
  constexpr int kSide = 224;
  constexpr double kEyeX = 0.42, kEyeY = -0.15, kEyeWidth = 0.2, kMouthY = 0.62, kMouthWidth = 0.34;
  const drawn::Face face{{rng.Uniform(90, 134), rng.Uniform(90, 134)}, rng.Uniform(45, 70), rng.Uniform(-0.3, 0.3)};
  const double right = i % 3 == 0 ? 0.005 : rng.Uniform(0.06, 0.13), left = i % 5 == 0 ? 0.005 : right;
  const double mouth = i % 2 == 0 ? 0.0 : rng.Uniform(0.08, 0.2), lip = 0.06;
  const auto colour = [&](double low, double high) {
    return drawn::Colour{rng.Uniform(low, high), rng.Uniform(low, high), rng.Uniform(low, high)};
  };
  const drawn::Colour ground = colour(0, 1), skin = {rng.Uniform(0.6, 1), rng.Uniform(0.4, 0.8), rng.Uniform(0.3, 0.7)},
                      hair = colour(0, 0.5), lips = {rng.Uniform(0.5, 0.9), 0.2, 0.2};
  portrait::LandmarkSample sample{render::Image(kSide, kSide, 3), render::Image(kSide, kSide, 1, 0), {}, {}, {}, i % 6};
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) {
      const Point p = face.Inverse({column + 0.5, row + 0.5});
      drawn::Colour at = ground;
      PictureClass of = PictureClass::kBackground;
      const auto set = [&](const drawn::Colour& value, PictureClass face_class) { at = value, of = face_class; };
      if (drawn::InEllipse(p, 0, -0.2, 1.15, 1.3)) set(hair, PictureClass::kHair);
      if (std::abs(std::abs(p.x()) - 1) < 0.12 && std::abs(p.y()) < 0.2) set(skin, PictureClass::kEars);
      if (drawn::InEllipse(p, 0, 0, 1, 1.2)) set(skin, PictureClass::kSkin);
      for (const double side : {-1.0, 1.0}) {
        if (std::abs(p.x() - side * kEyeX) < 0.26 && std::abs(p.y() + 0.45) < 0.05) set(hair, PictureClass::kBrows);
        const double open = side < 0 ? right : left;
        if (drawn::InEllipse(p, side * kEyeX, kEyeY, kEyeWidth, open)) set({1, 1, 1}, PictureClass::kEyes);
        if (open > 0.05 && drawn::InEllipse(p, side * kEyeX, kEyeY, 0.06, 0.06))
          set({0.1, 0.2, 0.3}, PictureClass::kEyes);
      }
      if (std::abs(p.x()) < 0.14 && std::abs(p.y() - 0.3) < 0.03) set({0.4, 0.25, 0.2}, PictureClass::kSkin);
      if (drawn::InEllipse(p, 0, kMouthY, kMouthWidth, lip + mouth)) set(lips, PictureClass::kLips);
      if (mouth > 0 && drawn::InEllipse(p, 0, kMouthY, 0.8 * kMouthWidth, mouth))
        set({0.15, 0, 0}, PictureClass::kMouth);
      for (int k = 0; k < 3; ++k) sample.picture.at(row, column, k) = uint8_t(255 * at[size_t(k)]);
      sample.mask.at(row, column) = uint8_t(of);
    }
  const auto add = [&](double u, double v) {
    const Point p = face.At(u, v);
    sample.landmarks.push_back(float(p.x()));
    sample.landmarks.push_back(float(p.y()));
    sample.visibility.push_back(p.x() >= 0 && p.y() >= 0 && p.x() < kSide && p.y() < kSide);
  };
  const auto on_ellipse = [&](double u, double v, double a, double b, double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    add(u + a * std::cos(angle), v + b * std::sin(angle));
  };
  for (int k = 0; k < 17; ++k) on_ellipse(0, 0, 1, 1.2, 180 - 11.25 * k);
  for (int k = 0; k < 5; ++k) add(-kEyeX - 0.26 + 0.13 * k, -0.45);
  for (int k = 0; k < 5; ++k) add(kEyeX - 0.26 + 0.13 * k, -0.45);
  for (int k = 0; k < 4; ++k) add(0, -0.15 + 0.15 * k);
  for (int k = 0; k < 5; ++k) add(-0.14 + 0.07 * k, 0.33);
  for (const int degrees : {180, 240, 300, 0, 60, 120}) on_ellipse(-kEyeX, kEyeY, kEyeWidth, right, degrees);
  for (const int degrees : {180, 240, 300, 0, 60, 120}) on_ellipse(kEyeX, kEyeY, kEyeWidth, left, degrees);
  for (int k = 0; k < 12; ++k) on_ellipse(0, kMouthY, kMouthWidth, lip + mouth, 180 + 30 * k);
  for (int k = 0; k < 8; ++k) on_ellipse(0, kMouthY, 0.8 * kMouthWidth, mouth, 180 + 45 * k);
  const auto mm = [](double open) { return float(2 * open * 70); };
  sample.gaps_mm = {mm(right), mm(left), mm(mouth)};
  return sample;
}

}  // namespace daumier::testing
