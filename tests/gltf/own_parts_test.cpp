#include "gltf/own_parts.h"

#include "gltf/head_file.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

namespace daumier::gltf {
namespace {

/// The ball's first ten triangles are of another material than the rest, and a third one is of none.
rig::RiggedHead HeadWithOwnMaterials() {
  rig::RiggedHead head = testing::BallHead();
  head.own_materials = {{.name = "unused"},
                        {.name = "collar (dark)", .colour = {0.1f, 0.2f, 0.3f}, .opacity = 0.5f},
                        {.name = "skin", .picture = std::make_shared<const std::string>("\x89PNG....")}};
  head.own.assign(size_t(head.mesh.triangles.rows()), 2);
  std::fill_n(head.own.begin(), 10, 1);
  for (rig::RiggedEye& eye : head.eyes) eye.own.assign(size_t(eye.mesh.triangles.rows()), 1);
  return head;
}

TEST(OwnMaterials, BecomeAMeshEachWithTheSameTargets) {
  const rig::RiggedHead head = HeadWithOwnMaterials();
  const testing::GlbReader file(HeadToGlb(head, nullptr, std::nullopt));
  const auto material = [&](const std::string& node) {
    return file.json()["materials"][file.primitive(node)["material"].get<size_t>()];
  };
  EXPECT_EQ(material("Head")["name"], "skin");
  EXPECT_TRUE(material("Head")["pbrMetallicRoughness"].contains("baseColorTexture"));
  EXPECT_EQ(material("Head_collar__dark_")["name"], "collar (dark)");
  EXPECT_EQ(material("Head_collar__dark_")["alphaMode"], "BLEND");
  EXPECT_NEAR(material("LeftEye")["pbrMetallicRoughness"]["baseColorFactor"][1].get<double>(), 0.2, 1e-6);
  EXPECT_EQ(file.json()["materials"].size(), 2u) << "what no triangle has is left out";
  EXPECT_EQ(file.Indices(file.primitive("Head_collar__dark_")["indices"]).size(), 30u);
  for (const char* node : {"Head", "Head_collar__dark_"}) {
    EXPECT_EQ(file.json()["meshes"][file.node(node)["mesh"].get<size_t>()]["extras"]["targetNames"],
              Json(head.targets.names));
    EXPECT_FALSE(file.primitive(node)["attributes"].contains("COLOR_0"));
  }
  int num_weights = 0;
  for (const Json& channel : file.json()["animations"][0]["channels"])
    num_weights += channel["target"]["path"] == "weights" ? 1 : 0;
  EXPECT_EQ(num_weights, 2);
}

TEST(OwnMaterials, ThatDoNotMoveHaveNoTargets) {
  rig::RiggedHead head = HeadWithOwnMaterials();
  for (int t = 0; t < 10; ++t)
    for (const int v : head.mesh.triangles.row(t)) head.targets.offsets.middleRows(3 * v, 3).setZero();
  const testing::GlbReader file(HeadToGlb(head, nullptr, std::nullopt));
  EXPECT_FALSE(file.primitive("Head_collar__dark_").contains("targets"));
}

TEST(OwnMaterials, AreCheckedToBeOneATriangle) {
  rig::RiggedHead head = HeadWithOwnMaterials();
  head.own[3] = 3;
  testing::ExpectError([&] { HeadToGlb(head, nullptr, std::nullopt); }, "a triangle has the material 3, there are 3");
  head.own.pop_back();
  testing::ExpectError([&] { HeadToGlb(head, nullptr, std::nullopt); }, "have materials of their own, expected");
}

TEST(NodeName, HasLettersDigitsAndUnderscores) {
  EXPECT_EQ(NodeName("Skin-01.b c"), "Skin_01_b_c");
}

}  // namespace
}  // namespace daumier::gltf
