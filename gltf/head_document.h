#pragma once
#include "gltf/glb_builder.h"
#include "gltf/head_animation.h"
#include "gltf/head_file.h"

namespace daumier::gltf {

/// @throws Error as HeadToGlb.
void CheckHead(const rig::RiggedHead& head, const render::Image* texture);

/// Indices of nodes.
struct HeadNodes {
  int head = 0, jaw = 0;
  std::optional<int> left_eye{}, right_eye{};
};

/// Adds the nodes of a checked head, with meshes and materials. The head's translation is what its parent lacks of the
/// pivot: (0, head_y, 0).
HeadNodes AddHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                  const HeadFileOptions& options, double head_y);

/// Adds the animation "Clip"; nothing if it has no keys.
void AddAnimation(GlbBuilder& builder, const HeadNodes& nodes, const HeadAnimation& animation);

/// `asset`: version, generator, licence and source.
void AddAsset(GlbBuilder& builder, const rig::RiggedHead& head);

/// A point of the head's frame (cm) from a pivot (cm), in metres.
geometry::Vector3 Metres(const geometry::Vector3& point, const geometry::Vector3& pivot);
Json ToArray(const geometry::Vector3& vector);

}  // namespace daumier::gltf
