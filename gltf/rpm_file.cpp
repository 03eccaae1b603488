#include "gltf/head_document.h"
#include "gltf/head_mesh.h"
#include "gltf/own_parts.h"
#include "gltf/rpm_skeleton.h"
#include "rig/gaze.h"
#include "rig/head_pose.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace daumier::gltf {
namespace {

constexpr int kOfSkin = 0, kOfTeeth = 1;

/// Own materials, or skin and teeth apart.
std::vector<int> RowsOfParts(const rig::RiggedHead& head) {
  if (!head.own_materials.empty()) return head.own;
  std::vector<int> rows;
  for (const faces::HeadMaterial material : head.materials) {
    const bool is_in_mouth = material == faces::HeadMaterial::kTooth || material == faces::HeadMaterial::kGum ||
                             material == faces::HeadMaterial::kTongue;
    rows.push_back(is_in_mouth ? kOfTeeth : kOfSkin);
  }
  return rows;
}

std::vector<faces::HeadMaterial> SelectMaterials(const std::vector<faces::HeadMaterial>& materials,
                                                 const std::vector<int>& rows) {
  std::vector<faces::HeadMaterial> selected;
  for (const int row : rows) selected.push_back(materials[size_t(row)]);
  return selected;
}

/// Targets of an eye that turn it: those of its own side, and of both sides.
rig::MorphTargets TargetsOfEye(const std::vector<std::string>& names, const geometry::Points& vertices,
                               const std::string& side) {
  rig::MorphTargets targets{names, Eigen::MatrixXf::Zero(3 * vertices.rows(), std::ssize(names))};
  const float angle = float(rig::kGazeAngle), out = side == "Left" ? angle : -angle;
  const std::array<std::pair<std::string, Eigen::Vector3f>, 6> turns = {{{"eyeLookUp" + side, {-angle, 0, 0}},
                                                                         {"eyeLookDown" + side, {angle, 0, 0}},
                                                                         {"eyeLookOut" + side, {0, out, 0}},
                                                                         {"eyeLookIn" + side, {0, -out, 0}},
                                                                         {"eyesLookUp", {-angle, 0, 0}},
                                                                         {"eyesLookDown", {angle, 0, 0}}}};
  for (const auto& [name, turn] : turns) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) continue;
    const geometry::Points moves = vertices * rig::RotationOf(turn).transpose() - vertices;
    targets.offsets.col(found - names.begin()) =
        Eigen::Map<const Eigen::VectorXd>(moves.data(), moves.size()).cast<float>();
  }
  return targets;
}

}  // namespace

void AddReadyPlayerMeHead(GlbBuilder& builder, const rig::RiggedHead& head, const render::Image* texture,
                          const HeadAnimation& animation, const HeadFileOptions& options) {
  const bool is_own = !head.own_materials.empty(), is_coloured = texture == nullptr && !is_own;
  const std::optional<int> atlas = is_own ? std::nullopt : AddTexture(builder, texture);
  const RpmSkeleton skeleton = AddRpmSkeleton(builder, options.pivot_height_m);
  HeadNodes nodes{.head = skeleton.head};
  const auto add_child = [&](int parent, Json child) {
    const int index = builder.Add("nodes", std::move(child));
    builder.json()["nodes"][size_t(parent)]["children"].push_back(index);
    return index;
  };
  const auto add_mesh = [&](const std::string& name, const geometry::TriangleMesh& mesh,
                            const std::vector<faces::HeadMaterial>& materials, const geometry::Vector3& pivot,
                            const rig::MorphTargets& targets, int surface, int parent) {
    const int index = AddMesh(builder, name.c_str(), mesh, materials, pivot, targets, surface, is_coloured, options);
    const int node = add_child(parent, {{"name", name}, {"mesh", index}});
    if (targets.num_targets() > 0) nodes.with_targets.push_back(node);
  };

  bool is_first = true;
  for (const OwnPart& part : PartsByMaterial(head.mesh, RowsOfParts(head), head.targets)) {
    const std::string other = is_own ? NodeName(head.own_materials[size_t(part.material)].name) : "Teeth";
    const std::string name = "Wolf3D_" + (is_first ? "Head" : other);
    const int surface = is_own ? AddOwnMaterial(builder, head.own_materials[size_t(part.material)])
                               : AddMaterial(builder, is_first ? "Wolf3D_Skin" : name.c_str(), atlas, 0.7);
    const bool moves = is_first || part.motion > 0;
    add_mesh(name, part.mesh, SelectMaterials(head.materials, part.triangles), head.head_pivot,
             moves ? head.targets : rig::MorphTargets(), surface, skeleton.head);
    is_first = false;
  }
  if (!head.eyes.empty()) {
    const int surface = is_own ? -1 : AddMaterial(builder, "Wolf3D_Eye", atlas, 0.2);
    for (const auto& [index, side] : {std::pair(size_t(1), "Left"), std::pair(size_t(0), "Right")}) {
      const rig::RiggedEye& eye = head.eyes[index];
      const int bone = add_child(skeleton.head, {{"name", std::string(side) + "Eye"},
                                                 {"translation", ToArray(Metres(eye.centre, head.head_pivot))}});
      const auto targets = TargetsOfEye(head.targets.names, eye.mesh.vertices, side);
      const geometry::Vector3 zero = geometry::Vector3::Zero();
      const std::string name = std::string("Eye") + side;
      if (!is_own) {
        add_mesh(name, eye.mesh, eye.materials, zero, targets, surface, bone);
        continue;
      }
      bool is_first_of_eye = true;
      for (const OwnPart& part : PartsByMaterial(eye.mesh, eye.own, targets)) {
        const rig::OwnMaterial& own = head.own_materials[size_t(part.material)];
        add_mesh(is_first_of_eye ? name : name + "_" + NodeName(own.name), part.mesh, {}, zero, targets,
                 AddOwnMaterial(builder, own), bone);
        is_first_of_eye = false;
      }
    }
  }
  for (const rig::HeadAttachment& attachment : head.attachments) {
    const std::string name = "Wolf3D_" + attachment.name;
    const int material = AddMaterial(builder, name.c_str(), std::nullopt, 0.8);
    const int mesh = AddAttachmentMesh(builder, name, attachment, head.head_pivot, material);
    add_child(skeleton.head, {{"name", name}, {"mesh", mesh}});
  }
  AddAnimation(builder, nodes, animation);
  builder.json()["scenes"] = Json::array({{{"nodes", {skeleton.armature}}}});
  builder.json()["scene"] = 0;
}

}  // namespace daumier::gltf
