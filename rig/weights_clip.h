#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace daumier::rig {

/// Weights of morph targets over time, and turns of head and eyes where a recording has them.
struct WeightsClip {
  double frames_per_second = 60;
  std::vector<std::string> names;  ///< T
  Eigen::MatrixXf weights;         ///< N x T: a row a frame, 0 .. 1.
  /// N x 3 each, or empty: pitch (about x), yaw (about y) and roll (about z) in radians, R = R_y R_x R_z; a positive
  /// yaw turns to the head's own left (+x), a positive pitch downwards, by the right-hand rule.
  Eigen::MatrixXf head, right_eye, left_eye;

  int num_frames() const { return static_cast<int>(weights.rows()); }
};

}  // namespace daumier::rig
