#include "reports/textured_head_file.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(TexturedHeadFile, BeginsWithTheVerticesOfTheFace) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const rig::HeadRig rig(face);
  const geometry::Points wide = face.neutral * Eigen::Vector3d(1.2, 1, 1).asDiagonal();
  const geometry::TriangleMesh head = HeadInAtlas(rig, wide);
  EXPECT_EQ(head.vertices.topRows(face.num_vertices()), wide);
  const rig::TextureSpace& space = rig.texture_space();
  EXPECT_EQ(head.uv, space.uv);
  EXPECT_EQ(head.uv_triangles, space.uv_triangles);
  // The same places as the rig's own mesh, corner by corner.
  const geometry::TriangleMesh joined = rig::JoinedMesh(rig.On(wide, {{}, Eigen::MatrixXf(wide.size(), 0)}));
  ASSERT_EQ(head.triangles.rows(), joined.triangles.rows());
  for (Eigen::Index t = 0; t < head.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(head.vertices.row(head.triangles(t, k)), joined.vertices.row(joined.triangles(t, k)));
  testing::ExpectError([&] { HeadInAtlas(rig, wide.topRows(5)); }, "a face of 5 vertices");
}

TEST(TexturedHeadFile, NamesItsPictureInEveryMaterial) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  const rig::HeadRig rig(face);
  WriteTexturedHead(folder / "anna.obj", rig, face.neutral, "texture.png");
  const geometry::PolygonMesh mesh = geometry::ReadObj(folder / "anna.obj");
  EXPECT_TRUE(mesh.has_uv());
  EXPECT_EQ(mesh.num_polygons(), rig.texture_space().triangles.rows());
  const std::string text = ReadFile(folder / "anna.obj"), materials = ReadFile(folder / "anna.mtl");
  EXPECT_TRUE(text.starts_with("mtllib anna.mtl\n"));
  for (const char* line :
       {"\ng face\n", "\ng neck\n", "\ng eyes\n", "\ng mouth\n", "\nusemtl head\n", "\nusemtl eyes\n"})
    EXPECT_NE(text.find(line), std::string::npos) << line;
  for (const char* material : {"newmtl head\n", "newmtl eyes\n"}) {
    const size_t begin = materials.find(material);
    ASSERT_NE(begin, std::string::npos) << material;
    EXPECT_NE(materials.find("map_Kd texture.png\n", begin), std::string::npos) << material;
  }
}

}  // namespace
}  // namespace daumier::reports
