#include "faces/gradient_scaling.h"

#include "core/error.h"
#include "geometry/flips.h"

#include <algorithm>

namespace daumier::faces {
namespace {

constexpr int kMaxUnflipRounds = 12;

std::vector<int> CornersOf(const geometry::Triangles& triangles, const std::vector<int>& rows) {
  std::vector<int> corners;
  for (const int row : rows) {
    for (int k = 0; k < 3; ++k) corners.push_back(triangles(row, k));
  }
  return corners;
}

}  // namespace

Eigen::VectorXd Fade(const geometry::Adjacency& neighbours, const std::vector<int>& vertices, double inside,
                     int blend_rings) {
  const std::vector<int> rings = geometry::RingsFrom(neighbours, vertices);
  Eigen::VectorXd fade(neighbours.size());
  for (int v = 0; v < neighbours.size(); ++v) {
    const double way = rings[v] < 0 ? 1.0 : std::min(1.0, rings[v] / (blend_rings + 1.0));
    fade[v] = inside + (1.0 - inside) * way;
  }
  return fade;
}

GradientScaling::GradientScaling(const geometry::TriangleMesh& mesh, const std::vector<int>& fixed)
    : mesh_(mesh),
      neighbours_(geometry::VertexNeighbours(mesh.triangles, static_cast<int>(mesh.vertices.rows()))),
      cotangents_(geometry::CornerCotangents(mesh)),
      solver_(geometry::CotangentLaplacian(mesh), fixed),
      fixed_points_(mesh.vertices(fixed, Eigen::all)) {}

geometry::Points GradientScaling::Rebuild(const geometry::Points& log_scales) const {
  DAUMIER_CHECK(log_scales.rows() == mesh_.vertices.rows(), "log scales of {} vertices for a mesh of {}",
                log_scales.rows(), mesh_.vertices.rows());
  const geometry::Points scales = log_scales.array().exp();
  Eigen::MatrixXd divergence = Eigen::MatrixXd::Zero(mesh_.vertices.rows(), 3);
  for (int f = 0; f < mesh_.triangles.rows(); ++f) {
    const auto corner = mesh_.triangles.row(f);
    const Eigen::RowVector3d scale = (scales.row(corner[0]) + scales.row(corner[1]) + scales.row(corner[2])) / 3;
    for (int k = 0; k < 3; ++k) {
      const int from = corner[(k + 1) % 3], to = corner[(k + 2) % 3];
      const Eigen::RowVector3d edge = mesh_.vertices.row(to) - mesh_.vertices.row(from);
      const Eigen::RowVector3d flux = 0.5 * cotangents_(f, k) * scale.cwiseProduct(edge);
      divergence.row(to) += flux;
      divergence.row(from) -= flux;
    }
  }
  return solver_.Solve(divergence, fixed_points_);
}

geometry::Points GradientScaling::RebuildWithoutFlips(geometry::Points log_scales, int blend_rings) const {
  geometry::Points result = Rebuild(log_scales);
  for (int round = 1; round <= kMaxUnflipRounds; ++round) {
    const std::vector<int> flipped = geometry::FlippedTriangles(mesh_.vertices, result, mesh_.triangles);
    if (flipped.empty()) break;
    const Eigen::VectorXd damping = Fade(neighbours_, CornersOf(mesh_.triangles, flipped), 0.5, round * blend_rings);
    log_scales.array().colwise() *= damping.array();
    result = Rebuild(log_scales);
  }
  return result;
}

}  // namespace daumier::faces
