#include "geometry/ply.h"

#include "core/files.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

TEST(Ply, WriteThenReadKeepsTheMesh) {
  const testing::TempDir folder;
  const TriangleMesh mesh = testing::Torus(2, 1, 7, 5);
  WritePly(folder / "torus.ply", mesh);
  const PolygonMesh read = ReadPly(folder / "torus.ply");
  EXPECT_LT((read.vertices - mesh.vertices).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(read.corners, std::vector<int>(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size()));
}

TEST(Ply, ReadsAsciiQuads) {
  const testing::TempDir folder;
  WriteFileAtomically(
      folder / "quad.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 3\n");
  const PolygonMesh mesh = ReadPly(folder / "quad.ply");
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.vertices(3, 2), 0.5);
}

TEST(Ply, RefusesMissingForeignAndCutFiles) {
  const testing::TempDir folder;
  ExpectError([&] { ReadPly(folder / "absent.ply"); }, "absent.ply");
  WriteFileAtomically(folder / "text.ply", "hello\n");
  ExpectError([&] { ReadPly(folder / "text.ply"); }, "not a PLY file");
  WritePly(folder / "sheet.ply", testing::FlatSheet(4));
  const std::string bytes = ReadFile(folder / "sheet.ply");
  for (const size_t length : {bytes.size() - 1, bytes.size() / 2, size_t{40}}) {
    WriteFileAtomically(folder / "cut.ply", bytes.substr(0, length));
    ExpectError([&] { ReadPly(folder / "cut.ply"); }, "cut.ply");
  }
}

TEST(Ply, RefusesToWriteWhatIsNoSurface) {
  const testing::TempDir folder;
  TriangleMesh mesh{Points::Zero(4, 3), Triangles(2, 3)};
  mesh.triangles << 0, 1, 2, 0, 1, 3;
  ExpectError([&] { WritePly(folder / "bad.ply", mesh); }, "run from vertex 0 to 1");
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.ply"));
}

}  // namespace
}  // namespace daumier::geometry
