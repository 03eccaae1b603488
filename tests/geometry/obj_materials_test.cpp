#include "geometry/obj_materials.h"

#include "core/files.h"
#include "tests/support/temp_dir.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

TEST(ReadUsedMaterials, ReadsNamesColoursAndPicturesOfEachPolygon) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "parts.mtl",
                      "newmtl two words\r\nKd 0.5 0.25 2\nd 0.5\n# map_Kd no.png\n"
                      "newmtl skin\nKa 1 1 1\nTr 0.25\nmap_Kd -bm 0.5 -clamp on maps\\skin colour.png\n");
  WriteFileAtomically(folder / "head.obj",
                      "mtllib parts.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl skin\nf 1 2 3\n"
                      "usemtl two words\nf 1 2 3\nf 3 2 1\nusemtl skin\nf 1 3 2\nusemtl unknown\nf 2 3 1\n");
  const UsedMaterials used = ReadUsedMaterials(folder / "head.obj");
  EXPECT_EQ(used.of_polygons, (std::vector<int>{-1, 0, 1, 1, 0, 2}));
  ASSERT_EQ(used.materials.size(), 3u);
  EXPECT_EQ(used.materials[0].name, "skin");
  EXPECT_EQ(used.materials[0].picture, folder / "maps/skin colour.png");
  EXPECT_EQ(used.materials[0].opacity, 0.75f);
  EXPECT_EQ(used.materials[1].name, "two words");
  EXPECT_EQ(used.materials[1].diffuse, (std::array<float, 3>{0.5f, 0.25f, 1}));
  EXPECT_EQ(used.materials[1].opacity, 0.5f);
  EXPECT_EQ(used.materials[2].name, "unknown");
  EXPECT_EQ(used.materials[2].diffuse, UsedMaterial().diffuse);
}

TEST(ReadUsedMaterials, LeavesMaterialsOfAnAbsentLibraryGrey) {
  testing::AllowWarnings();
  const testing::TempDir folder;
  WriteFileAtomically(folder / "head.obj", "mtllib gone.mtl\nusemtl a\nf 1 2 3\n");
  const UsedMaterials used = ReadUsedMaterials(folder / "head.obj");
  ASSERT_EQ(used.materials.size(), 1u);
  EXPECT_EQ(used.materials[0].diffuse, UsedMaterial().diffuse);
}

TEST(ReadUsedMaterials, AreNoneWithoutUsemtl) {
  const testing::TempDir folder;
  WriteFileAtomically(folder / "head.obj", "v 0 0 0\nf 1 2 3\n");
  const UsedMaterials used = ReadUsedMaterials(folder / "head.obj");
  EXPECT_TRUE(used.materials.empty());
  EXPECT_EQ(used.of_polygons, (std::vector<int>{-1}));
}

}  // namespace
}  // namespace daumier::geometry
