#include "geometry/half_edges.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

/// Two triangles that share the edge from 0 to 2.
TriangleMesh Square() {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TEST(HalfEdges, KeepVerticesTrianglesAndTheirOrder) {
  const TriangleMesh mesh = Square();
  const HalfEdgeMesh half_edges = ToHalfEdges(mesh);
  ASSERT_EQ(half_edges.n_vertices(), 4u);
  ASSERT_EQ(half_edges.n_faces(), 2u);
  EXPECT_EQ(half_edges.n_edges(), 5u);
  EXPECT_EQ(half_edges.point(OpenMesh::VertexHandle(2))[1], 1.0);
  for (int f = 0; f < 2; ++f) {
    int corner = 0;
    for (const auto vertex : half_edges.fv_range(OpenMesh::FaceHandle(f))) corner += vertex.idx();
    EXPECT_EQ(corner, mesh.triangles.row(f).sum());
  }
}

TEST(HalfEdges, BoundaryIsWhatHasOneTriangle) {
  const HalfEdgeMesh half_edges = ToHalfEdges(Square());
  int num_inner = 0;
  for (const auto edge : half_edges.edges()) num_inner += !half_edges.is_boundary(edge);
  EXPECT_EQ(num_inner, 1);
}

TEST(HalfEdges, RefuseAnEdgeWithThreeTriangles) {
  Triangles triangles(3, 3);
  triangles << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  testing::ExpectError([&] { ToHalfEdges(triangles, 5); }, "non-manifold");
}

}  // namespace
}  // namespace daumier::geometry
