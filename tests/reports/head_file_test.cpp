#include "reports/head_file.h"

#include "core/files.h"
#include "geometry/obj.h"
#include "tests/support/synthetic_face.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(HeadFile, HoldsTheFinishedHeadWithGroupsAndColours) {
  const testing::TempDir folder;
  const faces::FaceTemplate face = testing::SyntheticFace();
  const faces::FinishedHead head(face);
  WriteHead(folder / "anna.obj", head, face.neutral);
  const geometry::PolygonMesh mesh = geometry::ReadObj(folder / "anna.obj");
  EXPECT_EQ(mesh.vertices, head.Vertices(face.neutral)) << "the first V are the face's";
  EXPECT_EQ(mesh.num_polygons(), head.skin().rows() + head.parts().rows());
  const std::string text = ReadFile(folder / "anna.obj"), materials = ReadFile(folder / "anna.mtl");
  EXPECT_TRUE(text.starts_with("mtllib anna.mtl\n"));
  for (const char* group : {"\ng face\n", "\ng neck\n", "\ng eyes\n", "\ng mouth\n"})
    EXPECT_NE(text.find(group), std::string::npos) << group;
  for (const auto& named : faces::kHeadMaterials) {
    const bool is_there = named.material < faces::HeadMaterial::kTooth;
    EXPECT_EQ(text.find(std::string("\nusemtl ") + named.name + "\n") != std::string::npos, is_there) << named.name;
    EXPECT_EQ(materials.find(std::string("newmtl ") + named.name + "\n") != std::string::npos, is_there) << named.name;
  }
}

}  // namespace
}  // namespace daumier::reports
