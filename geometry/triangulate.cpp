#include "geometry/triangulate.h"

#include "core/error.h"
#include "geometry/corner_uv.h"
#include "geometry/nearest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace daumier::geometry {
namespace {

std::span<const int> CornersOf(const PolygonMesh& mesh, int polygon) {
  return std::span(mesh.corners).subspan(mesh.offsets[polygon], mesh.offsets[polygon + 1] - mesh.offsets[polygon]);
}

/// The corner from which a polygon fans out when it decides for itself.
int Apex(const Points& points, std::span<const int> corners) {
  if (corners.size() == 3) return corners[0];
  const int highest =
      *std::max_element(corners.begin(), corners.end(), [&](int a, int b) { return points(a, 1) < points(b, 1); });
  if (corners.size() != 4) return highest;
  const double first = (points.row(corners[0]) - points.row(corners[2])).squaredNorm();
  const double second = (points.row(corners[1]) - points.row(corners[3])).squaredNorm();
  if (std::abs(first - second) <= 1e-12 * (first + second)) return highest;
  return first < second ? corners[0] : corners[1];
}

double CentreX(const Points& points, std::span<const int> corners) {
  double sum = 0;
  for (const int v : corners) sum += points(v, 0);
  return sum / static_cast<double>(corners.size());
}

/// Polygons by their sorted corners.
std::map<std::vector<int>, int> PolygonsByCorners(const PolygonMesh& mesh) {
  std::map<std::vector<int>, int> polygons;
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const auto corners = CornersOf(mesh, p);
    std::vector<int> key(corners.begin(), corners.end());
    std::sort(key.begin(), key.end());
    polygons[key] = p;
  }
  return polygons;
}

/// apexes[p] for all polygons, symmetric under `mirror`.
std::vector<int> MirroredApexes(const PolygonMesh& mesh, const std::vector<int>& mirror) {
  DAUMIER_CHECK(static_cast<int>(mirror.size()) == mesh.vertices.rows(),
                "the mirror map has {} entries, the mesh {} vertices", mirror.size(), mesh.vertices.rows());
  const auto polygons = PolygonsByCorners(mesh);
  std::vector<int> apexes(mesh.num_polygons());
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const auto corners = CornersOf(mesh, p);
    std::vector<int> image;
    for (const int v : corners) image.push_back(mirror[v]);
    std::sort(image.begin(), image.end());
    const auto found = polygons.find(image);
    DAUMIER_CHECK(found != polygons.end(), "polygon {} has no mirror image", p);
    const bool decides = found->second == p || CentreX(mesh.vertices, corners) > 0;
    apexes[p] = decides ? Apex(mesh.vertices, corners) : mirror[Apex(mesh.vertices, CornersOf(mesh, found->second))];
  }
  return apexes;
}

/// For each triangle of Triangulate the positions of its corners in `mesh.corners`.
Triangles CornersOfTriangles(const PolygonMesh& mesh, const std::vector<int>& mirror) {
  std::vector<int> apexes(mesh.num_polygons());
  if (mirror.empty()) {
    for (int p = 0; p < mesh.num_polygons(); ++p) apexes[p] = Apex(mesh.vertices, CornersOf(mesh, p));
  } else {
    apexes = MirroredApexes(mesh, mirror);
  }
  Triangles triangles(static_cast<int>(mesh.corners.size()) - 2 * mesh.num_polygons(), 3);
  int row = 0;
  for (int p = 0; p < mesh.num_polygons(); ++p) {
    const auto corners = CornersOf(mesh, p);
    const int begin = mesh.offsets[p], n = static_cast<int>(corners.size());
    const int apex = static_cast<int>(std::find(corners.begin(), corners.end(), apexes[p]) - corners.begin());
    for (int k = 1; k + 1 < n; ++k) {
      triangles.row(row++) << begin + apex, begin + (apex + k) % n, begin + (apex + k + 1) % n;
    }
  }
  return triangles;
}

Triangles Select(const std::vector<int>& values, const Triangles& positions) {
  return positions.unaryExpr([&](int position) { return values[position]; });
}

}  // namespace

std::vector<int> FindMirror(const Points& points, double tolerance) {
  const VertexTree tree(points);
  std::vector<int> mirror(points.rows());
  for (int v = 0; v < points.rows(); ++v) {
    const NearestVertex nearest = tree.Nearest({-points(v, 0), points(v, 1), points(v, 2)});
    DAUMIER_CHECK(nearest.distance <= tolerance, "the mirror image of vertex {} is {} cm away from every vertex", v,
                  nearest.distance);
    mirror[v] = nearest.vertex;
  }
  for (int v = 0; v < points.rows(); ++v) {
    DAUMIER_CHECK(mirror[mirror[v]] == v, "vertices {} and {} share the mirror image {}", v, mirror[mirror[v]],
                  mirror[v]);
  }
  return mirror;
}

Triangles Triangulate(const PolygonMesh& mesh, const std::vector<int>& mirror) {
  return Select(mesh.corners, CornersOfTriangles(mesh, mirror));
}

TriangleMesh TriangulateMesh(const PolygonMesh& mesh, const std::vector<int>& mirror) {
  CheckUv(mesh);
  const Triangles positions = CornersOfTriangles(mesh, mirror);
  TriangleMesh result{mesh.vertices, Select(mesh.corners, positions)};
  if (!mesh.has_uv()) return result;
  result.uv = mesh.uv;
  result.uv_triangles = Select(mesh.uv_corners, positions);
  return result;
}

}  // namespace daumier::geometry
