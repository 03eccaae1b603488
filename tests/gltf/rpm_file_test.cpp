#include "gltf/glb_builder.h"
#include "gltf/head_file.h"
#include "tests/support/ball_head.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::gltf {
namespace {

rig::RiggedHead RpmHead() {
  rig::RiggedHead head = testing::BallHead();
  head.targets.names[0] = "viseme_sil";
  head.targets.names[1] = "eyesLookUp";
  head.targets.offsets.col(0).setZero();
  head.materials[0] = faces::HeadMaterial::kTooth;
  return head;
}

testing::GlbReader RpmFile(const rig::RiggedHead& head) {
  return testing::GlbReader(HeadToGlb(head, nullptr, rig::WeightsClip(), {.nodes = HeadNodeNames::kReadyPlayerMe}));
}

/// What TalkingHead 1.7.0 requires.
TEST(ReadyPlayerMeHead, HasTheFiftyTwoBonesUnderArmature) {
  const testing::GlbReader file = RpmFile(RpmHead());
  std::vector<std::string> names = {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "LeftEye", "RightEye"};
  for (const std::string side : {"Left", "Right"}) {
    for (const char* bone : {"Shoulder", "Arm", "ForeArm", "Hand", "UpLeg", "Leg", "Foot", "ToeBase"})
      names.push_back(side + bone);
    for (const char* finger : {"Thumb", "Index", "Middle", "Ring", "Pinky"})
      for (const char* joint : {"1", "2", "3"}) names.push_back(side + "Hand" + finger + joint);
  }
  ASSERT_EQ(names.size(), 54u);
  std::set<int> below;  // Armature.
  const auto collect = [&](const auto& self, int node) -> void {
    below.insert(node);
    for (const Json& child : file.json()["nodes"][size_t(node)].value("children", Json::array()))
      self(self, child.get<int>());
  };
  collect(collect, file.Node("Armature"));
  for (const std::string& name : names) EXPECT_TRUE(below.contains(file.Node(name))) << name;
  for (const char* mesh : {"Wolf3D_Head", "Wolf3D_Teeth", "EyeLeft", "EyeRight"})
    EXPECT_TRUE(below.contains(file.Node(mesh))) << mesh;
  EXPECT_EQ(below.size(), file.json()["nodes"].size());
}

TEST(ReadyPlayerMeHead, HasTheSameTargetsAtEveryFaceMesh) {
  const rig::RiggedHead head = RpmHead();
  const testing::GlbReader file = RpmFile(head);
  for (const char* name : {"Wolf3D_Head", "Wolf3D_Teeth", "EyeLeft", "EyeRight"}) {
    const Json& mesh = file.json()["meshes"][file.node(name)["mesh"].get<size_t>()];
    EXPECT_EQ(mesh["extras"]["targetNames"], Json(head.targets.names)) << name;
    EXPECT_EQ(mesh["weights"].size(), head.targets.names.size());
    EXPECT_EQ(mesh["primitives"].size(), 1u);
    EXPECT_EQ(file.primitive(name)["targets"].size(), head.targets.names.size());
    const std::string material = file.json()["materials"][file.primitive(name)["material"].get<size_t>()]["name"];
    EXPECT_TRUE(material.starts_with("Wolf3D_")) << material;
  }
  const auto triangles = [&](const char* name) { return file.Indices(file.primitive(name)["indices"]).size() / 3; };
  EXPECT_EQ(triangles("Wolf3D_Teeth"), 1u);
  EXPECT_EQ(triangles("Wolf3D_Head") + 1, size_t(head.mesh.triangles.rows()));
}

TEST(ReadyPlayerMeHead, TurnsEyesByThirtyDegreesAtTheirTargets) {
  const rig::RiggedHead head = RpmHead();
  const testing::GlbReader file = RpmFile(head);
  const auto& names = head.targets.names;
  const auto front = [&](const char* eye, const char* target) {
    const Json& primitive = file.primitive(eye);
    const FloatRows rest = file.Floats(primitive["attributes"]["POSITION"]);
    const auto place = size_t(std::ranges::find(names, target) - names.begin());
    const FloatRows moved = rest + file.Floats(primitive["targets"][place]["POSITION"]);
    Eigen::Index row = 0;
    rest.col(2).maxCoeff(&row);
    return Eigen::Vector3f(moved.row(row).transpose() / rest.row(row).norm());
  };
  EXPECT_NEAR(front("EyeLeft", "eyeLookOutLeft").x(), 0.5f, 0.02f) << "to its own left";
  EXPECT_NEAR(front("EyeLeft", "eyeLookInLeft").x(), -0.5f, 0.02f);
  EXPECT_NEAR(front("EyeRight", "eyeLookOutRight").x(), -0.5f, 0.02f);
  EXPECT_NEAR(front("EyeRight", "eyeLookOutLeft").x(), 0, 0.02f) << "the other eye";
  EXPECT_NEAR(front("EyeRight", "eyesLookUp").y(), 0.5f, 0.02f);
}

TEST(ReadyPlayerMeHead, ReachesTheGround) {
  const testing::GlbReader file = RpmFile(RpmHead());
  const FloatRows ground = file.Floats(file.primitive("Ground")["attributes"]["POSITION"]);
  EXPECT_EQ(ground.col(1).maxCoeff(), 0);
  EXPECT_LE(ground.cwiseAbs().maxCoeff(), 1e-4f);
}

}  // namespace
}  // namespace daumier::gltf
