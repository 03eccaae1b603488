#pragma once
#include "rig/weights_clip.h"

#include <Eigen/Core>

#include <numbers>

namespace daumier::rig {

enum class EyeSide { kRight, kLeft };

/// How far an eye turns at weight 1 of one of its targets eyeLook{Up, Down, In, Out}{Left, Right}.
inline constexpr double kGazeAngle = 30 * std::numbers::pi / 180;

/// Turns of an eyeball, N x 3 as WeightsClip::left_eye: those of the clip where it has them, else of its weights:
///   pitch = kGazeAngle (eyeLookDown - eyeLookUp), yaw = +-kGazeAngle (eyeLookOut - eyeLookIn), + for the left eye.
/// The targets of these names move lids; a target that the clip does not name counts as 0.
/// @throws Error if the clip has turns, but not a row a frame.
Eigen::MatrixXf EyeTurns(const WeightsClip& clip, EyeSide side);

}  // namespace daumier::rig
