#include "reports/rigged_head.h"

#include "core/error.h"
#include "core/parallel.h"
#include "render/draw.h"
#include "render/sheet.h"
#include "reports/face_surface.h"
#include "rig/texture_space.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace daumier::reports {
namespace {

constexpr double kMargin = 1.15;  ///< A head that nods stays in the picture.
constexpr int kSheetPicture = 300;
constexpr double kSideYaw = 40;
constexpr float kSeenThrough = 0.5f;  ///< Opacity below which an own material is left out.

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

uint8_t SrgbFromLinear(double linear) {
  const double s = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
  return uint8_t(std::lround(255 * std::clamp(s, 0.0, 1.0)));
}

/// The mean colour of a picture, sRGB.
render::Rgb MeanColour(const render::Image& picture) {
  std::array<double, 3> sums = {};
  for (size_t i = 0; i < picture.pixels.size(); ++i) sums[i % 3] += picture.pixels[i];
  render::Rgb mean;
  for (size_t c = 0; c < 3; ++c) mean[c] = uint8_t(sums[c] / std::max<double>(1, double(picture.pixels.size() / 3)));
  return mean;
}

/// The material with a picture that has most triangles as the textured surface, the others as triangles of one colour.
void ColourByOwnMaterials(const rig::RiggedHead& head, render::RenderInput& input) {
  std::vector<int> own = head.own;
  for (const rig::RiggedEye& eye : head.eyes) own.insert(own.end(), eye.own.begin(), eye.own.end());
  std::vector<std::shared_ptr<const render::Image>> pictures;
  std::vector<render::Rgb> colours;
  for (const rig::OwnMaterial& material : head.own_materials) {
    pictures.push_back(material.picture ? std::make_shared<const render::Image>(
                                              render::ToRgb(render::DecodeImage(*material.picture, material.name)))
                                        : nullptr);
    render::Rgb colour = pictures.back() ? MeanColour(*pictures.back()) : render::Rgb{255, 255, 255};
    for (size_t c = 0; c < 3; ++c) colour[c] = uint8_t(colour[c] * SrgbFromLinear(material.colour[c]) / 255);
    colours.push_back(colour);
  }
  int textured = -1;
  int64_t most = 0;
  for (int m = 0; m < int(pictures.size()); ++m) {
    const int64_t count = std::count(own.begin(), own.end(), m);
    if (pictures[size_t(m)] && count > most) most = count, textured = m;
  }
  std::vector<int> of_surface, others;
  for (size_t i = 0; i < own.size(); ++i) {
    if (head.own_materials[size_t(own[i])].opacity < kSeenThrough) continue;
    (own[i] == textured ? of_surface : others).push_back(int(i));
    if (own[i] != textured) input.closing_colours.push_back(colours[size_t(own[i])]);
  }
  input.closing_triangles = RowsOf(input.surface.triangles, others);
  input.surface.triangles = RowsOf(input.surface.triangles, of_surface);
  if (textured >= 0) {
    input.surface.uv_triangles = RowsOf(input.surface.uv_triangles, of_surface);
    input.texture = pictures[size_t(textured)];
  } else {
    input.surface.uv_triangles.resize(0, 3);
    input.surface.uv.resize(0, 2);
  }
}

/// Whether every edge has two triangles.
bool IsClosed(const geometry::TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> counts;
  for (const auto& t : mesh.triangles.rowwise())
    for (int k = 0; k < 3; ++k) ++counts[std::minmax(t[k], t[(k + 1) % 3])];
  return std::ranges::all_of(counts, [](const auto& edge) { return edge.second == 2; });
}

/// What is seen when nothing moves but the face: the head, of a whole body as well.
render::Frame FrameOfHead(const rig::RiggedHead& head, const geometry::Points& all) {
  constexpr double kLeastMoveOfFace = 0.1, kHeadPerFace = 1.75, kMuchLarger = 1.5;
  std::vector<int> moved;
  const rig::MorphTargets& targets = head.targets;
  for (int v = 0; v < head.mesh.vertices.rows(); ++v)
    for (Eigen::Index t = 0; t < targets.offsets.cols(); ++t)
      if (targets.offsets.col(t).segment<3>(3 * Eigen::Index(v)).norm() > kLeastMoveOfFace) {
        moved.push_back(v);
        break;
      }
  const render::Frame whole = render::FrameOf(all, kMargin);
  if (moved.empty()) return whole;
  const render::Frame face = render::FrameOf(head.mesh.vertices(moved, Eigen::all), kHeadPerFace);
  return kMuchLarger * face.half_height < whole.half_height ? face : whole;
}

/// Attachments as triangles with colours of their own, behind the vertices of the head.
void AddAttachments(const std::vector<rig::HeadAttachment>& attachments, render::RenderInput& input) {
  for (const rig::HeadAttachment& attachment : attachments) {
    const Eigen::Index first = input.surface.vertices.rows(), count = attachment.mesh.vertices.rows();
    input.surface.vertices.conservativeResize(first + count, Eigen::NoChange);
    input.surface.vertices.bottomRows(count) = attachment.mesh.vertices;
    const geometry::Triangles& triangles = attachment.mesh.triangles;
    input.closing_triangles.conservativeResize(input.closing_triangles.rows() + triangles.rows(), 3);
    input.closing_triangles.bottomRows(triangles.rows()) = triangles.array() + int(first);
    for (const auto& t : triangles.rowwise()) {
      const Eigen::RowVector3f colour =
          (attachment.colours.row(t[0]) + attachment.colours.row(t[1]) + attachment.colours.row(t[2])) / 3;
      render::Rgb bytes;
      for (int c = 0; c < 3; ++c) bytes[size_t(c)] = uint8_t(std::lround(255 * std::clamp(colour[c], 0.0F, 1.0F)));
      input.closing_colours.push_back(bytes);
      if (!input.closing_gloss.empty()) input.closing_gloss.push_back(0);
    }
  }
}

}  // namespace

RiggedHeadPictures::RiggedHeadPictures(const rig::RiggedHead& head, std::shared_ptr<const render::Image> texture)
    : head_(head), input_{.surface = rig::JoinedMesh(head)} {
  DAUMIER_CHECK(texture == nullptr || input_.surface.has_uv(), "a texture is given for a head without UV");
  const std::vector<faces::HeadMaterial> materials = JoinedMaterials(head);
  DAUMIER_CHECK(Eigen::Index(materials.size()) == input_.surface.triangles.rows(), "{} materials for {} triangles",
                materials.size(), input_.surface.triangles.rows());
  input_.is_solid = IsClosed(input_.surface);
  if (!head.own_materials.empty()) {
    ColourByOwnMaterials(head, input_);
  } else if (texture == nullptr) {
    ColourByMaterials(materials, input_);
  } else {
    input_.texture = std::move(texture);
  }
  AddAttachments(head.attachments, input_);
  frame_ = FrameOfHead(head, input_.surface.vertices);
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
