#include "geometry/detail_energy.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/triangle_tree.h"

#include <Eigen/SVD>

#include <algorithm>

namespace daumier::geometry {
namespace {

/// The cosine of the greatest angle between a tie and the inward normals at its ends.
constexpr double kTieCosine = 0.5;

/// The nearest vertex on the other side of the body, -1 where there is none.
int FarSide(const TriangleTree& tree, const Points& normals, int vertex, double max_distance) {
  const TriangleMesh& mesh = tree.mesh();
  const Vector3 place = mesh.vertices.row(vertex), reach = Vector3::Constant(max_distance);
  int best = -1;
  double best_distance = max_distance;
  for (const int f : tree.Overlapping({place - reach, place + reach})) {
    for (const int other : mesh.triangles.row(f)) {
      const Vector3 way = mesh.vertices.row(other).transpose() - place;
      const double distance = way.norm();
      const bool is_through =
          normals.row(vertex).dot(way) < -kTieCosine * distance && normals.row(other).dot(way) > kTieCosine * distance;
      if (!is_through || distance > best_distance || (distance == best_distance && other > best)) continue;
      best = other;
      best_distance = distance;
    }
  }
  return best;
}

std::vector<DetailEnergy::Tie> FindTies(const TriangleMesh& mesh, double max_distance) {
  const TriangleTree tree(mesh);
  const Points normals = VertexNormals(mesh);
  std::vector<DetailEnergy::Tie> ties;
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    const int other = FarSide(tree, normals, v, max_distance);
    if (other >= 0) ties.push_back({std::min(v, other), std::max(v, other)});
  }
  std::sort(ties.begin(), ties.end());
  ties.erase(std::unique(ties.begin(), ties.end()), ties.end());
  return ties;
}

SparseMatrix GraphLaplacian(const std::vector<DetailEnergy::Tie>& ties, int num_vertices) {
  std::vector<Eigen::Triplet<double>> triplets;
  for (const auto& [i, j] : ties) {
    for (const auto& [row, column, value] : {std::tuple{i, i, 1.0}, {j, j, 1.0}, {i, j, -1.0}, {j, i, -1.0}})
      triplets.emplace_back(row, column, value);
  }
  SparseMatrix matrix(num_vertices, num_vertices);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

/// Moments that determine a similarity: sum of q p^T and of |p|^2 over edges p at rest and q now.
struct Moments {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double spread = 0;

  void Add(const Eigen::RowVector3d& p, const Eigen::RowVector3d& q) {
    covariance += q.transpose() * p;
    spread += p.squaredNorm();
  }
  void Add(const Moments& other) {
    covariance += other.covariance;
    spread += other.spread;
  }
  Eigen::Matrix3d Similarity(double max_scale) const {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Vector3 sign = Vector3::Ones();
    if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) sign[2] = -1;
    const double scale = std::clamp(svd.singularValues().dot(sign) / spread, 1 / max_scale, max_scale);
    return scale * svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  }
};

}  // namespace

DetailEnergy::DetailEnergy(const TriangleMesh& mesh, const DetailOptions& options)
    : options_(options), rest_(mesh.vertices) {
  const int num_vertices = static_cast<int>(rest_.rows());
  neighbours_ = VertexNeighbours(mesh.triangles, num_vertices);
  for (int v = 0; v < num_vertices; ++v) {
    double spread = 0;
    for (const int other : neighbours_[v]) spread += (rest_.row(other) - rest_.row(v)).squaredNorm();
    DAUMIER_CHECK(spread > 0, "vertex {} belongs to no triangle that has a size; remove it", v);
  }
  ties_ = FindTies(mesh, options.max_thickness);
  const SparseMatrix edges = UniformLaplacian(mesh.triangles, num_vertices);
  laplacian_ = edges.diagonal().cwiseInverse().asDiagonal() * edges;
  details_ = laplacian_ * rest_;
  matrix_ = laplacian_.transpose() * laplacian_;
  matrix_ += options.edges * edges;
  matrix_ += options.thickness * GraphLaplacian(ties_, num_vertices);
}

std::vector<Eigen::Matrix3d> DetailEnergy::Similarities(const Points& now) const {
  const int num_vertices = static_cast<int>(rest_.rows());
  std::vector<Moments> rings(num_vertices);
  for (int i = 0; i < num_vertices; ++i) {
    for (const int j : neighbours_[i]) rings[i].Add(rest_.row(j) - rest_.row(i), now.row(j) - now.row(i));
  }
  for (const auto& [i, j] : ties_) {
    for (const int v : {i, j}) rings[v].Add(rest_.row(j) - rest_.row(i), now.row(j) - now.row(i));
  }
  std::vector<Eigen::Matrix3d> similarities(num_vertices);
  for (int i = 0; i < num_vertices; ++i) {
    Moments moments = rings[i];
    for (const int j : neighbours_[i]) moments.Add(rings[j]);
    similarities[i] = moments.Similarity(options_.max_scale);
  }
  return similarities;
}

Points DetailEnergy::Pull(const Points& now) const {
  DAUMIER_CHECK(now.rows() == rest_.rows(), "{} vertices, expected {}", now.rows(), rest_.rows());
  const std::vector<Eigen::Matrix3d> similarities = Similarities(now);
  const auto turned_way = [&](int i, int j) -> Eigen::RowVector3d {
    return 0.5 * (rest_.row(i) - rest_.row(j)) * (similarities[i] + similarities[j]).transpose();
  };
  Points turned(now.rows(), 3), pull = Points::Zero(now.rows(), 3);
  for (int i = 0; i < now.rows(); ++i) {
    turned.row(i) = details_.row(i) * similarities[i].transpose();
    for (const int j : neighbours_[i]) pull.row(i) += options_.edges * turned_way(i, j);
  }
  for (const auto& [i, j] : ties_) {
    const Eigen::RowVector3d way = options_.thickness * turned_way(i, j);
    pull.row(i) += way;
    pull.row(j) -= way;
  }
  return pull + laplacian_.transpose() * turned;
}

}  // namespace daumier::geometry
