#include "rig/gaze.h"

#include "core/error.h"

#include <algorithm>
#include <string>

namespace daumier::rig {
namespace {

/// N: the weights of a target; zeros where the clip does not name it.
Eigen::VectorXf GazeWeights(const WeightsClip& clip, const std::string& name) {
  const auto found = std::find(clip.names.begin(), clip.names.end(), name);
  if (found == clip.names.end()) return Eigen::VectorXf::Zero(clip.num_frames());
  return clip.weights.col(found - clip.names.begin());
}

}  // namespace

Eigen::MatrixXf EyeTurns(const WeightsClip& clip, EyeSide side) {
  const bool is_left = side == EyeSide::kLeft;
  const Eigen::MatrixXf& given = is_left ? clip.left_eye : clip.right_eye;
  if (given.size() > 0) {
    DAUMIER_CHECK(given.rows() == clip.num_frames() && given.cols() == 3,
                  "the clip turns an eye in {} x {} values, expected {} x 3", given.rows(), given.cols(),
                  clip.num_frames());
    return given;
  }
  const std::string suffix = is_left ? "Left" : "Right";
  const float angle = static_cast<float>(kGazeAngle), outwards = is_left ? angle : -angle;
  Eigen::MatrixXf turns = Eigen::MatrixXf::Zero(clip.num_frames(), 3);
  turns.col(0) = angle * (GazeWeights(clip, "eyeLookDown" + suffix) - GazeWeights(clip, "eyeLookUp" + suffix));
  turns.col(1) = outwards * (GazeWeights(clip, "eyeLookOut" + suffix) - GazeWeights(clip, "eyeLookIn" + suffix));
  return turns;
}

}  // namespace daumier::rig
