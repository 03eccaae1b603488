#pragma once
#include "gltf/glb_builder.h"

namespace daumier::gltf {

/// Nodes of a skeleton as Ready Player Me's avatars have it.
struct RpmSkeleton {
  int armature, head;  ///< The root, and the bone below which the head's meshes are.
};

/// Adds the root Armature with the 52 bones that TalkingHead 1.7.0 requires, HeadTop_End, and a triangle of 0.1 mm on the
/// ground, which lets a player that measures the avatar find its height. `height`: of the bone Head over the ground, m.
RpmSkeleton AddRpmSkeleton(GlbBuilder& builder, double height);

}  // namespace daumier::gltf
