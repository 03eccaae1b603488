#include "faces/controls/smooth_warps.h"

#include <cmath>

namespace daumier::faces {
namespace {

constexpr int kMaxDegree = 3;
constexpr double kEyeSpans = 0.03;

/// P_0 to P_3 at each value, a column a degree.
Eigen::MatrixXd Legendre(const Eigen::ArrayXd& x) {
  Eigen::MatrixXd values(x.size(), kMaxDegree + 1);
  values.col(0).setOnes();
  values.col(1) = x;
  values.col(2) = (3 * x.square() - 1) / 2;
  values.col(3) = (5 * x.cube() - 3 * x) / 2;
  return values;
}

}  // namespace

std::vector<GivenControl> SmoothWarps(const FaceTemplate& face_template) {
  const geometry::Points& points = face_template.neutral;
  const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  std::vector<Eigen::MatrixXd> powers;
  for (int k = 0; k < 3; ++k)
    powers.push_back(Legendre((2 * points.col(k).array() - low[k] - high[k]) / (high[k] - low[k])));
  const double unit = kEyeSpans * EyeSpan(face_template);
  std::vector<GivenControl> warps;
  for (int axis = 0; axis < 3; ++axis) {
    for (int a = 0; a <= kMaxDegree; ++a) {
      for (int b = 0; a + b <= kMaxDegree; ++b) {
        for (int c = 0; a + b + c <= kMaxDegree; ++c) {
          const int degree = a + b + c;
          if (degree == 0) continue;
          GivenControl& warp = warps.emplace_back();
          warp.name = std::string("warp_") + "xyz"[axis] + "_" + std::string(a, 'x') + std::string(b, 'y') +
                      std::string(c, 'z');
          warp.group = "warp";
          const bool is_symmetric = (a % 2 == 1) == (axis == 0);
          warp.sides = is_symmetric ? FaceControl::Sides::kMiddle : FaceControl::Sides::kSideways;
          warp.displacement = geometry::Points::Zero(points.rows(), 3);
          warp.displacement.col(axis) =
              unit / degree * powers[0].col(a).cwiseProduct(powers[1].col(b)).cwiseProduct(powers[2].col(c));
        }
      }
    }
  }
  return warps;
}

}  // namespace daumier::faces
