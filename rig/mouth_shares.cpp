#include "rig/mouth_shares.h"

#include "faces/open_mouth.h"
#include "geometry/poisson.h"

#include <algorithm>
#include <map>

namespace daumier::rig {
namespace {

float SmoothStep(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return float(x * x * (3 - 2 * x));
}

}  // namespace

Eigen::VectorXf ShareOfUpperLip(const faces::FaceTemplate& face_template) {
  constexpr double kBelow = 0.3, kAbove = 0.7;
  const faces::LipContours lips = faces::FindLipContours(face_template);
  std::map<int, double> values;
  for (const int v : lips.upper) values[v] = 1;
  for (const int v : lips.lower) values[v] = values.contains(v) ? 0.5 : 0;
  std::vector<int> held;
  Eigen::MatrixXd held_values(values.size(), 1);
  for (const auto& [v, value] : values) {
    held_values(Eigen::Index(held.size()), 0) = value;
    held.push_back(v);
  }
  const Eigen::MatrixXd field =
      geometry::SolvePoisson(geometry::CotangentLaplacian({face_template.neutral, face_template.triangles}), held,
                             Eigen::MatrixXd::Zero(face_template.num_vertices(), 1), held_values);
  return field.col(0).unaryExpr([&](double h) { return SmoothStep((h - kBelow) / (kAbove - kBelow)); }).cast<float>();
}

Eigen::VectorXf ShareOfLeftSide(const faces::FaceTemplate& face_template) {
  constexpr int kRightCorner = 48, kLeftCorner = 54;
  const auto& landmarks = face_template.annotation.landmarks;
  const geometry::Points& neutral = face_template.neutral;
  const double width = 1.2 * (neutral(landmarks[kLeftCorner], 0) - neutral(landmarks[kRightCorner], 0));
  return neutral.col(0).unaryExpr([&](double x) { return SmoothStep(x / width + 0.5); }).cast<float>();
}

Eigen::VectorXf ShareOfLips(const faces::FaceTemplate& face_template) {
  constexpr int kChin = 8, kLowerBorder = 57;
  constexpr double kEnd = 0.9;
  const faces::LipContours lips = faces::FindLipContours(face_template);
  const geometry::Points& neutral = face_template.neutral;
  const auto distance = [&](int vertex) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto* path : {&lips.upper, &lips.lower})
      for (const int v : *path) least = std::min(least, (neutral.row(v) - neutral.row(vertex)).norm());
    return least;
  };
  const auto& landmarks = face_template.annotation.landmarks;
  const double border = distance(landmarks[kLowerBorder]), end = kEnd * distance(landmarks[kChin]);
  Eigen::VectorXf share(face_template.num_vertices());
  for (int v = 0; v < share.size(); ++v) share[v] = 1 - SmoothStep((distance(v) - border) / (end - border));
  return share;
}

}  // namespace daumier::rig
