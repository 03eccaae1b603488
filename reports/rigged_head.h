#pragma once
#include "render/camera.h"
#include "render/image.h"
#include "render/shading.h"
#include "rig/head_pose.h"
#include "rig/rigged_head.h"

#include <memory>
#include <vector>

namespace daumier::reports {

/// Pictures of a rigged head in any pose, as users see it in other programs. Threads may share one.
class RiggedHeadPictures {
 public:
  /// `texture`: the atlas; null: materials have the colours of LookOf.
  /// @throws Error as rig::PosableHead, or if there is a texture and no UV.
  explicit RiggedHeadPictures(const rig::RiggedHead& head, std::shared_ptr<const render::Image> texture = nullptr);

  /// The head from the front, size x size, moved by yaw_degrees to its own left; a frame for every pose of the head.
  /// @throws Error as rig::PosableHead::Vertices.
  render::Image Draw(const rig::HeadPose& pose, int size, double yaw_degrees = 0,
                     const render::ShadingStyle& style = {}) const;
  /// The same as any camera sees it.
  render::Image Draw(const rig::HeadPose& pose, const render::Camera& camera,
                     const render::ShadingStyle& style = {}) const;

 private:
  rig::PosableHead head_;
  render::RenderInput input_;  ///< Without positions.
  render::Frame frame_;
};

/// The head in neutral pose, with closed eyes, an open mouth, a smile, raised brows and a look aside, from the front and
/// from a side: what one looks at first. Targets by ARKit's names; those that the head lacks leave a picture neutral.
render::Image RiggedHeadSheet(const rig::RiggedHead& head, std::shared_ptr<const render::Image> texture = nullptr);

}  // namespace daumier::reports
