#pragma once
#include "gltf/glb_builder.h"
#include "gltf/head_animation.h"
#include "gltf/head_file.h"

namespace daumier::gltf {

/// @throws Error as HeadToGlb.
void CheckHead(const rig::RiggedHead& head, const render::Image* texture);

/// Adds the atlas, if any; materials share it. Returns the texture.
std::optional<int> AddTexture(GlbBuilder& builder, const render::Image* texture);
/// Adds a material of the atlas. Returns it.
int AddMaterial(GlbBuilder& builder, const char* name, std::optional<int> texture, double roughness);

/// Indices of nodes.
struct HeadNodes {
  int head = 0, jaw = 0;
  std::optional<int> left_eye{}, right_eye{};
  std::vector<int> with_targets{};  ///< Those whose meshes have the targets; `head` is the first.
};

/// Adds the nodes of a checked head, with meshes and materials. The head's translation is what its parent lacks of the
/// pivot: (0, head_y, 0).
HeadNodes AddHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                  const HeadFileOptions& options, double head_y);

/// Adds the animation "Clip"; nothing if it has no keys.
void AddAnimation(GlbBuilder& builder, const HeadNodes& nodes, const HeadAnimation& animation);

/// As HeadNodeNames::kReadyPlayerMe: a file but for its `asset`. @throws Error as AddHead.
void AddReadyPlayerMeHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                          const HeadAnimation& animation, const HeadFileOptions& options);

/// `asset`: version, generator, licence and source.
void AddAsset(GlbBuilder& builder, const rig::RiggedHead& head);

/// A point of the head's frame (cm) from a pivot (cm), in metres.
geometry::Vector3 Metres(const geometry::Vector3& point, const geometry::Vector3& pivot);
Json ToArray(const geometry::Vector3& vector);

}  // namespace daumier::gltf
