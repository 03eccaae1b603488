#include "geometry/ply.h"

#include "core/error.h"
#include "core/files.h"
#include "geometry/half_edges.h"

// After the kernels, whose types its importers use.
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <sstream>

namespace daumier::geometry {
namespace {

using PolygonHalfEdges = OpenMesh::PolyMesh_ArrayKernelT<OpenMesh::DefaultTraitsDouble>;

/// OpenMesh reports to its own streams; its findings are told by our exceptions instead.
class SilentOpenMesh {
 public:
  SilentOpenMesh() {
    omerr().disable();
    omlog().disable();
  }
  ~SilentOpenMesh() {
    omerr().enable();
    omlog().enable();
  }
};

/// The count behind `element <name>` in a PLY header, 0 if there is none.
size_t HeaderCount(const std::string& bytes, const std::string& name) {
  std::istringstream header(bytes.substr(0, bytes.find("end_header")));
  size_t count = 0;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string keyword, element;
    if (words >> keyword >> element && keyword == "element" && element == name) words >> count;
  }
  return count;
}

}  // namespace

PolygonMesh ReadPly(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  DAUMIER_CHECK(bytes.starts_with("ply"), "{}: not a PLY file", path.string());
  // OpenMesh reads on for ever behind a header without an end.
  DAUMIER_CHECK(bytes.find("end_header") != std::string::npos, "{}: cut amid its header", path.string());
  const SilentOpenMesh silent;
  PolygonHalfEdges half_edges;
  std::istringstream stream(bytes);
  OpenMesh::IO::Options options;
  const bool is_read = OpenMesh::IO::read_mesh(half_edges, stream, ".ply", options);
  const size_t num_vertices = HeaderCount(bytes, "vertex"), num_polygons = HeaderCount(bytes, "face");
  DAUMIER_CHECK(is_read && half_edges.n_vertices() > 0, "{}: malformed or cut PLY file", path.string());
  DAUMIER_CHECK(half_edges.n_vertices() <= num_vertices, "{}: its polygons are no manifold surface", path.string());
  DAUMIER_CHECK(half_edges.n_vertices() == num_vertices && half_edges.n_faces() == num_polygons,
                "{}: {} vertices and {} polygons, its header says {} and {}", path.string(), half_edges.n_vertices(),
                half_edges.n_faces(), num_vertices, num_polygons);
  PolygonMesh mesh;
  mesh.vertices.resize(static_cast<int>(num_vertices), 3);
  for (const auto v : half_edges.vertices()) {
    const auto& p = half_edges.point(v);
    mesh.vertices.row(v.idx()) << p[0], p[1], p[2];
  }
  DAUMIER_CHECK(mesh.vertices.allFinite(), "{}: a position is not finite", path.string());
  for (const auto f : half_edges.faces()) {
    for (const auto v : half_edges.fv_range(f)) mesh.corners.push_back(v.idx());
    mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
  }
  return mesh;
}

void WritePly(const std::filesystem::path& path, const TriangleMesh& mesh) {
  const HalfEdgeMesh half_edges = ToHalfEdges(mesh);
  const SilentOpenMesh silent;
  std::ostringstream stream;
  const bool is_written = OpenMesh::IO::write_mesh(half_edges, stream, ".ply", OpenMesh::IO::Options::Binary);
  DAUMIER_CHECK(is_written, "{}: OpenMesh could not write the mesh", path.string());
  WriteFileAtomically(path, stream.str());
}

}  // namespace daumier::geometry
