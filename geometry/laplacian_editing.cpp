#include "geometry/laplacian_editing.h"

#include "core/error.h"
#include "geometry/topology.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <set>

namespace daumier::geometry {
namespace {

/// The least pivot, as a share of the largest, of a system whose handles hold the mesh; without handles there are
/// pivots of rounding size.
constexpr double kLeastHandlePivot = 1e-11;

/// A vertex with fewer neighbours than this, on a border, turns and scales with two rings: a similarity of so few
/// points could follow almost any move of theirs, and the border would be loose.
constexpr size_t kFewNeighbours = 4;

/// The vertices whose displacements determine T_i.
std::set<int> Ring(const Adjacency& neighbours, int i) {
  std::set<int> ring(neighbours[i].begin(), neighbours[i].end());
  if (ring.size() < kFewNeighbours) {
    for (const int j : neighbours[i]) ring.insert(neighbours[j].begin(), neighbours[j].end());
  }
  ring.insert(i);
  return ring;
}

Eigen::Matrix3d CrossMatrix(const Vector3& a) {
  Eigen::Matrix3d matrix;
  matrix << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return matrix;
}

/// The inverse of a symmetric positive semidefinite matrix, 0 in the directions in which it is singular.
Eigen::Matrix3d PseudoInverse(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix);
  Vector3 inverse = eigen.eigenvalues();
  const double least = 1e-10 * inverse.maxCoeff();
  for (double& value : inverse) value = value > least ? 1 / value : 0;
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

SparseMatrix DetailOperator(const TriangleMesh& mesh) {
  const int num_vertices = static_cast<int>(mesh.vertices.rows());
  const Adjacency neighbours = VertexNeighbours(mesh.triangles, num_vertices);
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(9 * (neighbours.values.size() + num_vertices));
  for (int i = 0; i < num_vertices; ++i) {
    DAUMIER_CHECK(!neighbours[i].empty(), "vertex {} belongs to no triangle; remove it before editing", i);
    const int num_neighbours = static_cast<int>(neighbours[i].size());
    const std::vector<int> near(neighbours[i].begin(), neighbours[i].end());
    const Vector3 detail = mesh.vertices.row(i) - mesh.vertices(near, Eigen::all).colwise().mean();
    const std::set<int> ring = Ring(neighbours, i);
    Points places = mesh.vertices(std::vector<int>(ring.begin(), ring.end()), Eigen::all);
    // About its mean, the best map p -> s p + h x p has s = sum p.q / sum p.p and J h = sum p x q, J the inertia.
    places.rowwise() -= places.colwise().mean().eval();
    const double spread = places.squaredNorm();
    const Eigen::Matrix3d inertia = spread * Eigen::Matrix3d::Identity() - places.transpose() * places;
    const Eigen::Matrix3d turn_detail = CrossMatrix(detail) * PseudoInverse(inertia);
    Eigen::Index place = 0;
    for (const int j : ring) {
      const Vector3 p = places.row(place++);
      const bool is_near = std::binary_search(near.begin(), near.end(), j);
      const double laplacian = j == i ? 1.0 : is_near ? -1.0 / num_neighbours : 0.0;
      const Eigen::Matrix3d block =
          laplacian * Eigen::Matrix3d::Identity() - detail * p.transpose() / spread + turn_detail * CrossMatrix(p);
      for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
          triplets.emplace_back(3 * i + row, 3 * j + column, block(row, column));
      }
    }
  }
  SparseMatrix matrix(3 * num_vertices, 3 * num_vertices);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

LaplacianEditor::LaplacianEditor(const TriangleMesh& mesh, const std::vector<int>& handle_ids,
                                 const Eigen::VectorXd& weights)
    : handles_(handle_ids), weights_(weights), num_vertices_(static_cast<int>(mesh.vertices.rows())) {
  DAUMIER_CHECK(weights.size() == static_cast<Eigen::Index>(handle_ids.size()), "{} weights for {} handles",
                weights.size(), handle_ids.size());
  Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(3 * Eigen::Index(num_vertices_));
  for (size_t k = 0; k < handles_.size(); ++k) {
    const int v = handles_[k];
    DAUMIER_CHECK(v >= 0 && v < num_vertices_, "handle {} is out of range, there are {} vertices", v, num_vertices_);
    DAUMIER_CHECK(diagonal[3 * v] == 0, "vertex {} is a handle twice", v);
    DAUMIER_CHECK(weights[k] > 0, "handle {} has the weight {}, which is not positive", v, weights[k]);
    diagonal.segment<3>(3 * Eigen::Index(v)).setConstant(weights[k]);
  }
  const SparseMatrix detail = DetailOperator(mesh);
  SparseMatrix system = detail.transpose() * detail;
  system += SparseMatrix(diagonal.asDiagonal());
  factor_ = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(system);
  const bool is_regular = factor_->info() == Eigen::Success &&
                          factor_->vectorD().minCoeff() > kLeastHandlePivot * factor_->vectorD().maxCoeff();
  DAUMIER_CHECK(is_regular, "{} handles do not hold the mesh: each part of it needs three that are not in one line",
                handles_.size());
}

Points LaplacianEditor::Solve(const Points& targets) const {
  DAUMIER_CHECK(targets.rows() == static_cast<Eigen::Index>(handles_.size()), "{} targets for {} handles",
                targets.rows(), handles_.size());
  DAUMIER_CHECK(targets.allFinite(), "a handle's target is not finite");
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(3 * Eigen::Index(num_vertices_));
  for (size_t k = 0; k < handles_.size(); ++k)
    rhs.segment<3>(3 * Eigen::Index(handles_[k])) = weights_[k] * targets.row(k).transpose();
  const Eigen::VectorXd solution = factor_->solve(rhs);
  return Eigen::Map<const Points>(solution.data(), num_vertices_, 3);
}

Points EditLaplacian(const TriangleMesh& mesh, const std::vector<int>& handle_ids, const Eigen::VectorXd& weights,
                     const Points& targets) {
  return LaplacianEditor(mesh, handle_ids, weights).Solve(targets);
}

}  // namespace daumier::geometry
