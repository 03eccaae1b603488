#include "reports/rigged_head.h"

#include "tests/support/ball_head.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

rig::HeadPose Neutral(const rig::RiggedHead& head) {
  return rig::PoseNamed(head.targets.names, {});
}

TEST(RiggedHeadPictures, ShowTheColoursOfMaterialsOrThoseOfTheTexture) {
  const rig::RiggedHead head = testing::BallHead();
  const render::ShadingStyle flat{.flatness = 1.0, .supersampling = 1};
  const render::Image plain = RiggedHeadPictures(head).Draw(Neutral(head), 64, 0, flat);
  EXPECT_EQ(plain.at(50, 32, 0), flat.clay[0]);
  const auto blue = std::make_shared<render::Image>(4, 4, 3, 0);
  for (int texel = 0; texel < 16; ++texel) blue->at(texel / 4, texel % 4, 2) = 255;
  const render::Image textured = RiggedHeadPictures(head, blue).Draw(Neutral(head), 64, 0, flat);
  EXPECT_EQ(textured.at(50, 32, 0), 0);
  EXPECT_EQ(textured.at(50, 32, 2), 255);
}

TEST(RiggedHeadPictures, FollowThePoseInOneFrame) {
  const rig::RiggedHead head = testing::BallHead();
  const RiggedHeadPictures pictures(head);
  const render::Image neutral = pictures.Draw(Neutral(head), 64);
  rig::HeadPose open = rig::PoseNamed(head.targets.names, {{"jawOpen", 1.0f}}), turned = Neutral(head);
  turned.head = {0, 0.5f, 0};
  EXPECT_NE(pictures.Draw(open, 64), neutral);
  EXPECT_NE(pictures.Draw(turned, 64), neutral);
  EXPECT_EQ(pictures.Draw(Neutral(head), 64), neutral);
  EXPECT_NE(pictures.Draw(Neutral(head), 64, 40), neutral);
}

TEST(RiggedHeadPictures, ShowAttachmentsThatTurnWithTheHead) {
  rig::RiggedHead head = testing::BallHead();
  const RiggedHeadPictures plain(head);
  rig::HeadAttachment hat{"Hat", head.mesh, Eigen::MatrixXf(head.mesh.vertices.rows(), 3)};
  hat.mesh.vertices *= 1.2;
  hat.colours.rowwise() = Eigen::RowVector3f(0, 0, 1);
  head.attachments.push_back(hat);
  const RiggedHeadPictures pictures(head);
  const render::ShadingStyle flat{.flatness = 1.0, .supersampling = 1};
  EXPECT_EQ(pictures.Draw(Neutral(head), 64, 0, flat).at(32, 32, 0), 0) << "blue hides all";
  EXPECT_EQ(pictures.Draw(Neutral(head), 64, 0, flat).at(32, 32, 2), 255);
  EXPECT_NE(plain.Draw(Neutral(head), 64, 0, flat).at(50, 32, 0), 0);
}

TEST(RiggedHeadPictures, AreMadeByThreads) {
  const rig::RiggedHead head = testing::BallHead();
  const RiggedHeadPictures pictures(head);
  testing::ExpectTheSameFromThreads(2, [&] { return pictures.Draw(Neutral(head), 24); });
}

TEST(RiggedHeadPictures, RefuseATextureWithoutUv) {
  rig::RiggedHead head = testing::BallHead();
  head.mesh.uv.resize(0, 2);
  head.mesh.uv_triangles.resize(0, 3);
  for (rig::RiggedEye& eye : head.eyes) {
    eye.mesh.uv.resize(0, 2);
    eye.mesh.uv_triangles.resize(0, 3);
  }
  testing::ExpectError([&] { RiggedHeadPictures(head, std::make_shared<render::Image>(4, 4, 3)); }, "without UV");
}

TEST(RiggedHeadSheet, HasSixPosesFromTwoSides) {
  const rig::RiggedHead head = testing::BallHead();
  const render::Image sheet = RiggedHeadSheet(head);
  EXPECT_GT(sheet.width, 6 * 300);
  EXPECT_GT(sheet.height, 2 * 300);
  EXPECT_EQ(sheet.channels, 3);
}

}  // namespace
}  // namespace daumier::reports
