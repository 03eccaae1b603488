#pragma once
#include "rig/blend.h"
#include "rig/rigged_head.h"
#include "rig/weights_clip.h"

#include <Eigen/Core>

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace daumier::rig {

/// What a head does at one time. Turns: pitch, yaw, roll as in WeightsClip; those of the eyes are relative to the head.
struct HeadPose {
  std::vector<float> weights;  ///< T
  Eigen::Vector3f head = Eigen::Vector3f::Zero(), right_eye = Eigen::Vector3f::Zero(),
                  left_eye = Eigen::Vector3f::Zero();
};

/// These weights of `targets` by name, eyes turned as EyeTurns; names that are no target are left out.
HeadPose PoseNamed(const std::vector<std::string>& targets,
                   std::initializer_list<std::pair<std::string_view, float>> weights);

/// The frames of a clip for a head with `targets`, eyes turned as EyeTurns. Targets that the clip does not name are 0.
/// @throws Error if the clip names a target that the head does not have, or as EyeTurns.
std::vector<HeadPose> PosesOf(const WeightsClip& clip, const std::vector<std::string>& targets);

/// R_y(yaw) R_x(pitch) R_z(roll), radians.
Eigen::Matrix3d RotationOf(const Eigen::Vector3f& turn);

/// A rigged head in any pose. Threads may share one.
class PosableHead {
 public:
  /// Copies what it needs. @throws Error as Blend, or if the head has other than 0 or 2 eyes.
  explicit PosableHead(const RiggedHead& head);

  /// Positions, cm, of the vertices of JoinedMesh(head), then of its attachments: the blend of the skin, each eyeball turned
  /// about its centre, attachments; then all turned about head_pivot. @throws Error unless the pose has a weight a target.
  geometry::Points Vertices(const HeadPose& pose) const;

 private:
  Blend skin_;
  std::vector<geometry::Points> eyes_;  ///< About their centres.
  std::vector<geometry::Points> attachments_;
  std::vector<geometry::Vector3> eye_centres_;
  geometry::Vector3 head_pivot_;
};

}  // namespace daumier::rig
