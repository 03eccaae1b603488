#include "gltf/rpm_skeleton.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace daumier::gltf {
namespace {

/// Places in a T-pose, as shares of the height of the bone Head; of a side that at +x, the avatar's left.
struct RpmJoint {
  const char* name;
  const char* parent;
  double x, y, z;
};
constexpr std::array<RpmJoint, 6> kRpmTrunk = {{{"Hips", "", 0, 0.66, 0},
                                                {"Spine", "Hips", 0, 0.72, 0},
                                                {"Spine1", "Spine", 0, 0.79, 0},
                                                {"Spine2", "Spine1", 0, 0.86, 0},
                                                {"Neck", "Spine2", 0, 0.94, 0},
                                                {"Head", "Neck", 0, 1, 0}}};
constexpr std::array<RpmJoint, 8> kRpmSide = {{{"Shoulder", "Spine2", 0.04, 0.91, 0},
                                               {"Arm", "Shoulder", 0.11, 0.91, 0},
                                               {"ForeArm", "Arm", 0.28, 0.91, 0},
                                               {"Hand", "ForeArm", 0.44, 0.91, 0},
                                               {"UpLeg", "Hips", 0.06, 0.64, 0},
                                               {"Leg", "UpLeg", 0.06, 0.34, 0},
                                               {"Foot", "Leg", 0.06, 0.06, 0},
                                               {"ToeBase", "Foot", 0.06, 0.01, 0.08}}};
constexpr std::array<const char*, 5> kRpmFingers = {"Thumb", "Index", "Middle", "Ring", "Pinky"};

std::vector<std::pair<std::string, RpmJoint>> FingersOf(const std::string& side) {
  std::vector<std::pair<std::string, RpmJoint>> joints;
  for (size_t f = 0; f < kRpmFingers.size(); ++f)
    for (int k = 1; k <= 3; ++k)
      joints.emplace_back(side + "Hand" + kRpmFingers[f] + std::to_string(k),
                          RpmJoint{"", "", 0.47 + 0.02 * k, 0.91, 0.03 - 0.012 * double(f)});
  return joints;
}

void AddGround(GlbBuilder& builder, int armature) {
  constexpr float kSide = 1e-4f;
  FloatRows corners(3, 3);
  corners << 0, 0, 0, kSide, 0, 0, 0, 0, -kSide;
  const FloatRows up = Eigen::RowVector3f(0, 1, 0).replicate(3, 1);
  const std::array<uint32_t, 3> order = {0, 1, 2};
  Json attributes;
  attributes["POSITION"] = builder.AddAttribute(corners, kPositionExponent, true);
  attributes["NORMAL"] = builder.AddAttribute(up, kNormalExponent);
  const Json primitive = {{"attributes", attributes}, {"indices", builder.AddIndices(order, 3)}};
  const int mesh = builder.Add("meshes", {{"name", "Ground"}, {"primitives", Json::array({primitive})}});
  const int node = builder.Add("nodes", {{"name", "Ground"}, {"mesh", mesh}});
  builder.json()["nodes"][size_t(armature)]["children"].push_back(node);
}

}  // namespace

RpmSkeleton AddRpmSkeleton(GlbBuilder& builder, double height) {
  std::map<std::string, std::pair<int, std::array<double, 3>>> known;  // Node and place.
  known[""] = {builder.Add("nodes", {{"name", "Armature"}, {"children", Json::array()}}), {0, 0, 0}};
  const auto add = [&](const std::string& name, const std::string& parent, const std::array<double, 3>& place) {
    const auto& [parent_node, parent_place] = known.at(parent);
    Json translation = Json::array();
    for (size_t k = 0; k < 3; ++k) translation.push_back(height * (place[k] - parent_place[k]));
    const int node = builder.Add("nodes", {{"name", name}, {"translation", translation}});
    builder.json()["nodes"][size_t(parent_node)]["children"].push_back(node);
    known[name] = {node, place};
  };
  for (const RpmJoint& joint : kRpmTrunk) add(joint.name, joint.parent, {joint.x, joint.y, joint.z});
  add("HeadTop_End", "Head", {0, 1.11, 0});
  for (const auto& [side, sign] : {std::pair("Left", 1.0), std::pair("Right", -1.0)}) {
    for (const RpmJoint& joint : kRpmSide) {
      const std::string parent = joint.parent;
      add(side + std::string(joint.name), known.contains(parent) ? parent : side + parent,
          {sign * joint.x, joint.y, joint.z});
    }
    for (const auto& [name, joint] : FingersOf(side)) {
      const bool is_first = name.back() == '1';
      const std::string parent =
          is_first ? std::string(side) + "Hand" : name.substr(0, name.size() - 1) + char(name.back() - 1);
      add(name, parent, {sign * joint.x, joint.y, joint.z});
    }
  }
  AddGround(builder, known.at("").first);
  return {known.at("").first, known.at("Head").first};
}

}  // namespace daumier::gltf
