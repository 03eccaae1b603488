#include "geometry/half_edges.h"

#include "core/error.h"
#include "geometry/topology.h"

namespace daumier::geometry {
namespace {

HalfEdgeMesh Build(const Triangles& triangles, int num_vertices, const Points* points) {
  CheckManifold(triangles, num_vertices);
  HalfEdgeMesh half_edges;
  half_edges.reserve(num_vertices, 3 * triangles.rows() / 2 + num_vertices, triangles.rows());
  for (int v = 0; v < num_vertices; ++v) {
    const Vector3 p = points ? Vector3(points->row(v)) : Vector3::Zero();
    half_edges.add_vertex({p.x(), p.y(), p.z()});
  }
  for (int f = 0; f < triangles.rows(); ++f) {
    const auto handle =
        half_edges.add_face(OpenMesh::VertexHandle(triangles(f, 0)), OpenMesh::VertexHandle(triangles(f, 1)),
                            OpenMesh::VertexHandle(triangles(f, 2)));
    DAUMIER_CHECK(handle.is_valid(), "triangle {} does not fit the surface of the triangles before it", f);
  }
  return half_edges;
}

}  // namespace

HalfEdgeMesh ToHalfEdges(const Triangles& triangles, int num_vertices) {
  return Build(triangles, num_vertices, nullptr);
}

HalfEdgeMesh ToHalfEdges(const TriangleMesh& mesh) {
  return Build(mesh.triangles, static_cast<int>(mesh.vertices.rows()), &mesh.vertices);
}

}  // namespace daumier::geometry
