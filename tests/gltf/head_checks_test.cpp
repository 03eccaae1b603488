#include "gltf/head_document.h"
#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace daumier::gltf {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Expects that the ball head is refused after `spoil`.
void ExpectRefused(const std::function<void(rig::RiggedHead&)>& spoil, const std::string& part,
                   const render::Image* texture = nullptr) {
  rig::RiggedHead head = testing::BallHead();
  EXPECT_NO_THROW(CheckHead(head, texture));
  spoil(head);
  testing::ExpectError([&] { CheckHead(head, texture); }, part);
}

TEST(CheckHead, RefusesSizesThatDisagree) {
  ExpectRefused([](auto& head) { head.targets.offsets.conservativeResize(30, 52); }, "targets of 30 numbers for 200");
  ExpectRefused([](auto& head) { head.targets.names.pop_back(); }, "51 names for 52 targets");
  ExpectRefused([](auto& head) { head.materials.pop_back(); }, "395 materials for 396 triangles");
  ExpectRefused([](auto& head) { head.mesh.triangles.resize(0, 3); }, "has no triangles");
  ExpectRefused([](auto& head) { head.mesh.triangles(3, 1) = 4000; }, "triangle 3 of the head names vertex 4000");
}

TEST(CheckHead, RefusesNumbersThatAreNotFiniteWhereTheyAreUsed) {
  ExpectRefused([](auto& head) { head.mesh.vertices(7, 1) = kMissing; }, "vertex 7 of the head is not finite");
  ExpectRefused([](auto& head) { head.targets.offsets(22, 3) = float(kMissing); },
                "target eyeLookOutLeft moves vertex 7");
  ExpectRefused([](auto& head) { head.jaw_pivot.y() = kMissing; }, "a pivot of the head");
  ExpectRefused([](auto& head) { head.eyes[1].centre.x() = kMissing; }, "the centre of an eye");
  ExpectRefused([](auto& head) { head.eyes[0].mesh.vertices(2, 2) = kMissing; }, "vertex 2 of the eye");

  rig::RiggedHead head = testing::BallHead();
  head.mesh.vertices.conservativeResize(head.mesh.vertices.rows() + 1, 3);
  head.mesh.vertices.bottomRows(1).setConstant(kMissing);
  head.targets.offsets.conservativeResize(3 * head.mesh.vertices.rows(), 52);
  EXPECT_NO_THROW(CheckHead(head, nullptr)) << "no triangle uses that vertex";
}

TEST(CheckHead, RefusesNamesThatProgramsDoNotKeepApart) {
  ExpectRefused([](auto& head) { head.targets.names[4] = "jawOpen"; }, "two targets have the name 'jawOpen'");
  ExpectRefused([](auto& head) { head.targets.names[4] = "JawOpen"; }, "or differ in case alone");
  ExpectRefused([](auto& head) { head.targets.names[4] = "eye.L"; }, "'eye.L' is not made of letters");
  ExpectRefused([](auto& head) { head.targets.names[4] = ""; }, "'' is not made of letters");
}

TEST(CheckHead, RefusesEyesThatAreNotAPairFromRightToLeft) {
  ExpectRefused([](auto& head) { head.eyes.pop_back(); }, "1 eyes, expected 0 or 2");
  ExpectRefused([](auto& head) { std::swap(head.eyes[0], head.eyes[1]); }, "right one (less x) first");
}

TEST(CheckHead, RefusesATextureForAMeshWithoutUv) {
  const render::Image texture(4, 4, 3);
  ExpectRefused(
      [](auto& head) {
        head.mesh.uv.resize(0, 2);
        head.mesh.uv_triangles.resize(0, 3);
      },
      "the head has no UV", &texture);
}

TEST(CheckHead, RefusesAttachmentsThatAreNoMeshOrHaveNoColours) {
  rig::RiggedHead head = daumier::testing::BallHead();
  rig::HeadAttachment hair{"Hair", head.mesh, Eigen::MatrixXf::Zero(head.mesh.vertices.rows(), 3)};
  head.attachments = {hair};
  EXPECT_NO_THROW(CheckHead(head, nullptr));
  head.attachments[0].colours.resize(1, 3);
  daumier::testing::ExpectError([&] { CheckHead(head, nullptr); }, "Hair has not a colour a vertex");
  head.attachments[0] = hair;
  head.attachments[0].mesh.triangles(0, 0) = -1;
  daumier::testing::ExpectError([&] { CheckHead(head, nullptr); }, "no mesh with finite vertices");
  head.attachments[0] = hair;
  head.attachments[0].name = "my hair";
  daumier::testing::ExpectError([&] { CheckHead(head, nullptr); }, "not named by letters");
}

}  // namespace
}  // namespace daumier::gltf
