#include "geometry/debris.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/submesh.h"
#include "geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace daumier::geometry {
namespace {

using PieceBox = Eigen::AlignedBox3d;

constexpr double kSmallShare = 0.01;
constexpr double kReach = 0.15;

struct Piece {
  double area = 0;
  PieceBox box;
  bool is_kept = false;
};

PieceBox Enlarged(const PieceBox& box) {
  const Vector3 margin = Vector3::Constant(kReach * box.sizes().maxCoeff());
  return {box.min() - margin, box.max() + margin};
}

}  // namespace

CleanSurface RemoveDebris(const TriangleMesh& mesh) {
  DAUMIER_CHECK(mesh.triangles.rows() > 0, "a surface needs at least one triangle");
  const auto num_vertices = static_cast<int>(mesh.vertices.rows());
  const std::vector<int> labels = ConnectedComponents(VertexNeighbours(mesh.triangles, num_vertices));
  std::vector<Piece> pieces(1 + *std::max_element(labels.begin(), labels.end()));
  const Eigen::VectorXd areas = TriangleAreas(mesh);
  const auto label_of = [&](Eigen::Index f) { return labels[mesh.triangles(f, 0)]; };
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    Piece& piece = pieces[label_of(f)];
    piece.area += areas[f];
    for (const int v : mesh.triangles.row(f)) piece.box.extend(mesh.vertices.row(v).transpose());
  }
  Piece& largest =
      *std::max_element(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
  largest.is_kept = true;
  PieceBox kept = largest.box;
  // A round that adds nothing is the last; every second one makes the box larger by its reach.
  for (bool grows = true; grows;) {
    grows = false;
    const PieceBox reach = Enlarged(kept);
    for (Piece& piece : pieces) {
      if (piece.is_kept || piece.box.isEmpty() || !reach.intersects(piece.box)) continue;
      piece.is_kept = grows = true;
      kept.extend(piece.box);
    }
  }
  CleanSurface clean;
  for (Piece& piece : pieces) {
    if (piece.box.isEmpty() || piece.is_kept) continue;
    piece.is_kept = piece.area >= kSmallShare * largest.area;
    if (!piece.is_kept) ++clean.num_pieces_removed;
  }
  std::vector<int> used;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (!pieces[label_of(f)].is_kept) continue;
    for (const int v : mesh.triangles.row(f)) used.push_back(v);
  }
  const VertexMap map = MapKept(used, num_vertices);
  clean.mesh = {SelectPoints(mesh.vertices, map), SelectTriangles(mesh.triangles, map)};
  return clean;
}

}  // namespace daumier::geometry
