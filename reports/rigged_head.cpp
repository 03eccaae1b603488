#include "reports/rigged_head.h"

#include "core/error.h"
#include "core/parallel.h"
#include "render/sheet.h"
#include "reports/face_surface.h"
#include "rig/texture_space.h"

#include <array>

namespace daumier::reports {
namespace {

constexpr double kMargin = 1.15;  ///< A head that nods stays in the picture.
constexpr int kSheetPicture = 300;
constexpr double kSideYaw = 40;

std::vector<faces::HeadMaterial> JoinedMaterials(const rig::RiggedHead& head) {
  std::vector<faces::HeadMaterial> materials = head.materials;
  for (const rig::RiggedEye& eye : head.eyes)
    materials.insert(materials.end(), eye.materials.begin(), eye.materials.end());
  return materials;
}

geometry::Triangles RowsOf(const geometry::Triangles& triangles, const std::vector<int>& rows) {
  return triangles(rows, Eigen::all);
}

/// Skin as the surface, the other materials as triangles with colours of their own.
void ColourByMaterials(const std::vector<faces::HeadMaterial>& materials, render::RenderInput& input) {
  std::vector<int> skin, others;
  for (size_t i = 0; i < materials.size(); ++i) {
    (materials[i] == faces::HeadMaterial::kSkin ? skin : others).push_back(int(i));
    if (materials[i] == faces::HeadMaterial::kSkin) continue;
    const MaterialLook look = LookOf(materials[i]);
    input.closing_colours.push_back(look.colour);
    input.closing_gloss.push_back(look.gloss);
  }
  input.closing_triangles = RowsOf(input.surface.triangles, others);
  input.surface.triangles = RowsOf(input.surface.triangles, skin);
  input.surface.uv_triangles.resize(0, 3);
  input.surface.uv.resize(0, 2);
}

}  // namespace

RiggedHeadPictures::RiggedHeadPictures(const rig::RiggedHead& head, std::shared_ptr<const render::Image> texture)
    : head_(head), input_{.surface = rig::JoinedMesh(head), .is_solid = true} {
  DAUMIER_CHECK(texture == nullptr || input_.surface.has_uv(), "a texture is given for a head without UV");
  const std::vector<faces::HeadMaterial> materials = JoinedMaterials(head);
  DAUMIER_CHECK(Eigen::Index(materials.size()) == input_.surface.triangles.rows(), "{} materials for {} triangles",
                materials.size(), input_.surface.triangles.rows());
  frame_ = render::FrameOf(input_.surface.vertices, kMargin);
  if (texture == nullptr) ColourByMaterials(materials, input_);
  input_.texture = std::move(texture);
}

render::Image RiggedHeadPictures::Draw(const rig::HeadPose& pose, int size, double yaw_degrees,
                                       const render::ShadingStyle& style) const {
  return Draw(pose, render::TurnedCamera(frame_.centre, frame_.half_height, size, yaw_degrees), style);
}

render::Image RiggedHeadPictures::Draw(const rig::HeadPose& pose, const render::Camera& camera,
                                       const render::ShadingStyle& style) const {
  render::RenderInput input = input_;
  input.surface.vertices = head_.Vertices(pose);
  return RenderMesh(input, camera, style);
}

render::Image RiggedHeadSheet(const rig::RiggedHead& head, std::shared_ptr<const render::Image> texture) {
  const RiggedHeadPictures pictures(head, std::move(texture));
  const auto pose = [&](std::initializer_list<std::pair<std::string_view, float>> weights) {
    return rig::PoseNamed(head.targets.names, weights);
  };
  const std::array<std::pair<const char*, rig::HeadPose>, 6> poses = {
      {{"neutral", pose({})},
       {"eyeBlinkLeft, eyeBlinkRight", pose({{"eyeBlinkLeft", 1.0f}, {"eyeBlinkRight", 1.0f}})},
       {"jawOpen 0.7", pose({{"jawOpen", 0.7f}})},
       {"mouthSmileLeft, mouthSmileRight", pose({{"mouthSmileLeft", 1.0f}, {"mouthSmileRight", 1.0f}})},
       {"browInnerUp, browOuterUp",
        pose({{"browInnerUp", 1.0f}, {"browOuterUpLeft", 1.0f}, {"browOuterUpRight", 1.0f}})},
       {"eyeLookOutLeft, eyeLookInRight", pose({{"eyeLookOutLeft", 1.0f}, {"eyeLookInRight", 1.0f}})}}};
  std::vector<render::SheetCell> cells;
  ForEachInOrder(
      2 * int(poses.size()),
      [&](int i) {
        const bool is_front = i < int(poses.size());
        const auto& [caption, shown] = poses[size_t(i) % poses.size()];
        return render::SheetCell{pictures.Draw(shown, kSheetPicture, is_front ? 0 : kSideYaw), is_front ? "" : caption};
      },
      [&](render::SheetCell cell) { cells.push_back(std::move(cell)); });
  return render::MakeSheet(cells, int(poses.size()));
}

}  // namespace daumier::reports
