#include "studio/head_files.h"

#include "geometry/obj.h"
#include "geometry/obj_materials.h"
#include "geometry/ply.h"
#include "render/image.h"
#include "rig/texture_space.h"
#include "tests/support/ball_head.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::studio {
namespace {

namespace fs = std::filesystem;

gltf::HeadInFile PlainBall() {
  gltf::HeadInFile head;
  head.head = testing::BallHead();
  return head;
}

/// The ball with a blue picture and a red tuft.
gltf::HeadInFile ColouredBall() {
  gltf::HeadInFile head = PlainBall();
  auto picture = std::make_shared<render::Image>(4, 4, 3, 0);
  for (int texel = 0; texel < 16; ++texel) picture->at(texel / 4, texel % 4, 2) = 255;
  head.texture = picture;
  rig::HeadAttachment tuft{"Hair", {}, Eigen::MatrixXf::Zero(3, 3)};
  tuft.mesh.vertices = geometry::Points{{0, 11, 0}, {1, 11, 0}, {0, 14, 0}};
  tuft.mesh.triangles = geometry::Triangles{{0, 1, 2}};
  tuft.colours.col(0).setOnes();
  head.head.attachments.push_back(tuft);
  return head;
}

TEST(HeadFiles, AMeshIsTheHeadAtRestWithItsPicture) {
  const testing::TempDir folder;
  const gltf::HeadInFile head = ColouredBall();
  const geometry::TriangleMesh joined = rig::JoinedMesh(head.head);
  WriteHeadMesh(folder / "head.obj", head);
  const geometry::PolygonMesh mesh = geometry::ReadObj(folder / "head.obj");
  EXPECT_EQ(mesh.vertices, joined.vertices);
  EXPECT_EQ(mesh.num_polygons(), joined.triangles.rows());
  EXPECT_TRUE(mesh.has_uv());
  const geometry::UsedMaterials used = geometry::ReadUsedMaterials(folder / "head.obj");
  ASSERT_EQ(used.materials.size(), 1u);
  EXPECT_EQ(used.materials[0].picture.filename(), "texture.png");
  EXPECT_EQ(render::ReadImage(folder / "texture.png"), *head.texture);
  EXPECT_EQ(geometry::ReadObj(folder / "head_hair.obj").vertices.rows(), 3);
  const geometry::UsedMaterials hair = geometry::ReadUsedMaterials(folder / "head_hair.obj");
  EXPECT_EQ(hair.materials[0].diffuse, (std::array<float, 3>{1, 0, 0}));
}

TEST(HeadFiles, APlyHasTheSameVertices) {
  const testing::TempDir folder;
  const gltf::HeadInFile head = ColouredBall();
  WriteHeadMesh(folder / "head.ply", head);
  const geometry::PolygonMesh mesh = geometry::ReadPly(folder / "head.ply");
  EXPECT_LT((mesh.vertices - rig::JoinedMesh(head.head).vertices).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(geometry::ReadPly(folder / "head_hair.ply").num_polygons(), 1);
  EXPECT_FALSE(fs::exists(folder / "texture.png")) << "a PLY names no picture";
}

TEST(HeadFiles, WithoutAPictureTheMeshHasAPlainColour) {
  const testing::TempDir folder;
  WriteHeadMesh(folder / "head.obj", PlainBall());
  EXPECT_TRUE(geometry::ReadUsedMaterials(folder / "head.obj").materials[0].picture.empty());
  EXPECT_FALSE(fs::exists(folder / "texture.png"));
}

TEST(HeadFiles, ATurntableShowsItFromAllSides) {
  const testing::TempDir folder;
  WriteHeadTurntable(folder.path(), ColouredBall(), {.frames = 4, .size = 64}, Task());
  const render::Image front = render::ReadImage(folder / "turn_001.png");
  EXPECT_EQ(front.width, 64);
  EXPECT_GT(front.at(32, 32, 2), front.at(32, 32, 0)) << "the picture is blue";
  EXPECT_NE(front, render::ReadImage(folder / "turn_002.png")) << "eyes and tuft turn";
  for (const char* name : {"turn_001.png", "turn_003.png"}) {  // The head is within the picture.
    const render::Image picture = render::ReadImage(folder / name);
    for (int i = 0; i < 64; ++i)
      for (const auto& [row, column] : {std::pair(0, i), std::pair(63, i), std::pair(i, 0), std::pair(i, 63)})
        for (int channel = 0; channel < 3; ++channel)
          ASSERT_EQ(picture.at(row, column, channel), picture.at(0, 0, channel)) << row << ' ' << column;
  }
  EXPECT_TRUE(fs::exists(folder / "turntable.png"));
}

}  // namespace
}  // namespace daumier::studio
