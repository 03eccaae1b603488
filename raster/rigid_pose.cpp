#include "raster/rigid_pose.h"

#include <cmath>

namespace daumier::raster {
namespace {

template <class T>
struct AngleTable {
  explicit AngleTable(const Pose<T>& pose)
      : cx(std::cos(pose[0])),
        sx(std::sin(pose[0])),
        cy(std::cos(pose[1])),
        sy(std::sin(pose[1])),
        cz(std::cos(pose[2])),
        sz(std::sin(pose[2])) {}
  T cx, sx, cy, sy, cz, sz;
};

}  // namespace

template <class T>
std::array<T, 9> RotationOf(const Pose<T>& pose) {
  const AngleTable<T> a(pose);
  return {a.cz * a.cy,
          a.cz * a.sy * a.sx - a.sz * a.cx,
          a.cz * a.sy * a.cx + a.sz * a.sx,
          a.sz * a.cy,
          a.sz * a.sy * a.sx + a.cz * a.cx,
          a.sz * a.sy * a.cx - a.cz * a.sx,
          -a.sy,
          a.cy * a.sx,
          a.cy * a.cx};
}

template <class T>
void ApplyPose(const Pose<T>& pose, int64_t num_points, const T* points, T* posed) {
  const std::array<T, 9> r = RotationOf(pose);
  for (int64_t i = 0; i < 3 * num_points; i += 3) {
    const T x = points[i], y = points[i + 1], z = points[i + 2];
    posed[i] = r[0] * x + r[1] * y + r[2] * z + pose[3];
    posed[i + 1] = r[3] * x + r[4] * y + r[5] * z + pose[4];
    posed[i + 2] = r[6] * x + r[7] * y + r[8] * z + pose[5];
  }
}

template <class T>
void RotationBackward(const Pose<T>& pose, const std::array<T, 9>& g, Pose<T>& pose_gradient) {
  const AngleTable<T> a(pose);
  const std::array<T, 9> r = RotationOf(pose);
  // dR/dpitch: column 1 -> column 2, column 2 -> -column 1.
  for (int row = 0; row < 3; ++row)
    pose_gradient[0] += g[3 * row + 1] * r[3 * row + 2] - g[3 * row + 2] * r[3 * row + 1];
  const std::array<T, 9> by_yaw = {-a.cz * a.sy, a.cz * a.cy * a.sx, a.cz * a.cy * a.cx,
                                   -a.sz * a.sy, a.sz * a.cy * a.sx, a.sz * a.cy * a.cx,
                                   -a.cy,        -a.sy * a.sx,       -a.sy * a.cx};
  for (int i = 0; i < 9; ++i) pose_gradient[1] += g[i] * by_yaw[i];
  // dR/droll: row 0 -> -row 1, row 1 -> row 0.
  for (int column = 0; column < 3; ++column) pose_gradient[2] += g[3 + column] * r[column] - g[column] * r[3 + column];
}

template <class T>
void ApplyPoseBackward(const Pose<T>& pose, int64_t num_points, const T* points, const T* posed_gradient,
                       Pose<T>& pose_gradient, T* point_gradient) {
  std::array<T, 9> by_rotation = {};
  for (int64_t i = 0; i < 3 * num_points; i += 3) {
    for (int row = 0; row < 3; ++row) {
      const T g = posed_gradient[i + row];
      pose_gradient[3 + row] += g;
      for (int column = 0; column < 3; ++column) by_rotation[3 * row + column] += g * points[i + column];
    }
  }
  RotationBackward(pose, by_rotation, pose_gradient);
  if (point_gradient == nullptr) return;
  const std::array<T, 9> r = RotationOf(pose);
  for (int64_t i = 0; i < 3 * num_points; i += 3) {
    const T gx = posed_gradient[i], gy = posed_gradient[i + 1], gz = posed_gradient[i + 2];
    for (int column = 0; column < 3; ++column) {
      point_gradient[i + column] += r[column] * gx + r[3 + column] * gy + r[6 + column] * gz;
    }
  }
}

template std::array<float, 9> RotationOf(const Pose<float>&);
template std::array<double, 9> RotationOf(const Pose<double>&);
template void ApplyPose(const Pose<float>&, int64_t, const float*, float*);
template void ApplyPose(const Pose<double>&, int64_t, const double*, double*);
template void RotationBackward(const Pose<float>&, const std::array<float, 9>&, Pose<float>&);
template void RotationBackward(const Pose<double>&, const std::array<double, 9>&, Pose<double>&);
template void ApplyPoseBackward(const Pose<float>&, int64_t, const float*, const float*, Pose<float>&, float*);
template void ApplyPoseBackward(const Pose<double>&, int64_t, const double*, const double*, Pose<double>&, double*);

}  // namespace daumier::raster
