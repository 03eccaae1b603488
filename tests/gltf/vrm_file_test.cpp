#include "gltf/head_file.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/glb_reader.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace daumier::gltf {
namespace {

using testing::BallHead;

TEST(HeadToVrm, HasTheBonesThatVrmRequiresEachANodeOfItsOwn) {
  const testing::GlbReader file(HeadToVrm(BallHead(), nullptr));
  const Json& vrm = file.json()["extensions"]["VRMC_vrm"];
  EXPECT_EQ(vrm["specVersion"], "1.0");
  EXPECT_EQ(file.json()["extensionsUsed"], Json({"VRMC_vrm"}));
  std::set<int> nodes;
  for (const auto& [bone, place] : vrm["humanoid"]["humanBones"].items()) nodes.insert(place["node"].get<int>());
  EXPECT_EQ(nodes.size(), vrm["humanoid"]["humanBones"].size());
  for (const char* bone : {"hips", "spine", "head", "leftUpperLeg", "leftLowerLeg", "leftFoot", "rightUpperLeg",
                           "rightLowerLeg", "rightFoot", "leftUpperArm", "leftLowerArm", "leftHand", "rightUpperArm",
                           "rightLowerArm", "rightHand", "leftEye", "rightEye"}) {
    EXPECT_TRUE(vrm["humanoid"]["humanBones"].contains(bone)) << bone;
  }
  EXPECT_EQ(vrm["humanoid"]["humanBones"]["leftEye"]["node"], file.Node("LeftEye"));
}

TEST(HeadToVrm, StandsInATPoseWithItsHeadAtTheGivenHeight) {
  const testing::GlbReader file(HeadToVrm(BallHead(), nullptr, {.pivot_height_m = 2}));
  const Json& nodes = file.json()["nodes"];
  std::map<int, Eigen::Vector3d> places;
  std::vector<int> open = file.json()["scenes"][0]["nodes"];
  ASSERT_EQ(open.size(), 1u);
  const auto translation = [&](int node) {
    const std::vector<double> values = nodes[size_t(node)]["translation"];
    return Eigen::Vector3d(values[0], values[1], values[2]);
  };
  places[open[0]] = translation(open[0]);
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    for (const int child : nodes[size_t(node)].value("children", std::vector<int>())) {
      EXPECT_FALSE(places.contains(child)) << "a node with two parents";
      places[child] = places[node] + translation(child);
      open.push_back(child);
    }
  }
  EXPECT_EQ(places.size(), nodes.size()) << "every node is in the scene";
  EXPECT_TRUE(places[file.Node("Head")].isApprox(Eigen::Vector3d(0, 2, 0), 1e-12));
  EXPECT_GT(places[file.Node("LeftHand")].x(), places[file.Node("LeftArm")].x()) << "the own left is +x";
  EXPECT_GT(places[file.Node("LeftFoot")].y(), 0);
  EXPECT_NEAR(places[file.Node("LeftHand")].y(), places[file.Node("LeftArm")].y(), 1e-12);
}

TEST(HeadToVrm, TurnsEyesEquallyFarUpAndDown) {
  const testing::GlbReader file(HeadToVrm(BallHead(), nullptr));
  const Json& look_at = file.json()["extensions"]["VRMC_vrm"]["lookAt"];
  EXPECT_EQ(look_at["type"], "bone");
  EXPECT_EQ(look_at["rangeMapVerticalUp"], look_at["rangeMapVerticalDown"]);
  EXPECT_NEAR(look_at["rangeMapHorizontalOuter"]["outputScale"].get<double>(), 30, 1e-9);
  // Eyes (+-3, 4, 7), pivot (0, 1, -1), cm.
  const std::vector<double> offset = look_at["offsetFromHeadBone"];
  EXPECT_NEAR(offset[0], 0, 1e-12);
  EXPECT_NEAR(offset[1], 0.03, 1e-12);
  EXPECT_NEAR(offset[2], 0.08, 1e-12);
}

TEST(HeadToVrm, StatesTitleAuthorsAndLicence) {
  const testing::GlbReader file(HeadToVrm(BallHead(), nullptr, {.title = "Ball", .authors = {"A", "B"}}));
  const Json& meta = file.json()["extensions"]["VRMC_vrm"]["meta"];
  EXPECT_EQ(meta["name"], "Ball");
  EXPECT_EQ(meta["authors"], Json({"A", "B"}));
  EXPECT_EQ(meta["copyrightInformation"], "CC0-1.0");
  EXPECT_EQ(meta["licenseUrl"], "https://vrm.dev/licenses/1.0/");
  EXPECT_EQ(meta["references"], Json::array({"ball"}));
}

TEST(HeadToVrm, HasExpressionsOfTheMeshOfItsHeadAndNoAnimation) {
  const testing::GlbReader file(HeadToVrm(BallHead(), nullptr));
  const Json& expressions = file.json()["extensions"]["VRMC_vrm"]["expressions"];
  EXPECT_EQ(expressions["custom"]["JawOpen"]["morphTargetBinds"][0]["node"], file.Node("Head"));
  EXPECT_FALSE(file.json().contains("animations"));
}

TEST(HeadToVrm, RefusesWhatVrmDoesNotAllow) {
  const auto expect_error = [](const HeadFileOptions& options, const char* part) {
    testing::ExpectError([&] { HeadToVrm(BallHead(), nullptr, options); }, part);
  };
  expect_error({.title = ""}, "needs a title");
  expect_error({.authors = {}}, "needs an author");
  expect_error({.authors = {"A", ""}}, "has no name");
  rig::RiggedHead head = BallHead();
  head.eyes.clear();
  testing::ExpectError([&] { HeadToVrm(head, nullptr); }, "needs a head with eyes");
}

}  // namespace
}  // namespace daumier::gltf
