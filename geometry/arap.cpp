#include "geometry/arap.h"

#include "core/error.h"

#include <Eigen/SVD>

#include <algorithm>
#include <utility>

namespace daumier::geometry {

ArapDeformer::ArapDeformer(const TriangleMesh& mesh, std::vector<int> handle_ids)
    : rest_(mesh.vertices), laplacian_(CotangentLaplacian(mesh)), handles_(std::move(handle_ids)) {
  const int num_vertices = int(rest_.rows());
  DAUMIER_CHECK(!handles_.empty(), "a deformation has no handle");
  std::vector<int> place(size_t(num_vertices), -1);  // Of a handle among the handles.
  for (size_t k = 0; k < handles_.size(); ++k) {
    const int v = handles_[k];
    DAUMIER_CHECK(v >= 0 && v < num_vertices, "handle {} is no vertex (the mesh has {})", v, num_vertices);
    DAUMIER_CHECK(place[size_t(v)] < 0, "vertex {} is a handle twice", v);
    place[size_t(v)] = int(k);
  }
  std::vector<int> row_of(size_t(num_vertices), -1);
  for (int v = 0; v < num_vertices; ++v) {
    if (place[size_t(v)] >= 0) continue;
    row_of[size_t(v)] = int(free_.size());
    free_.push_back(v);
  }
  std::vector<Eigen::Triplet<double>> inner, border;
  for (int column = 0; column < laplacian_.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(laplacian_, column); entry; ++entry) {
      const int row = row_of[size_t(entry.row())];
      if (row < 0) continue;
      if (place[size_t(entry.col())] >= 0) {
        border.emplace_back(row, place[size_t(entry.col())], entry.value());
      } else {
        inner.emplace_back(row, row_of[size_t(entry.col())], entry.value());
      }
    }
  }
  const Eigen::Index num_free(free_.size());
  SparseMatrix matrix(num_free, num_free);
  matrix.setFromTriplets(inner.begin(), inner.end());
  free_by_handles_.resize(num_free, Eigen::Index(handles_.size()));
  free_by_handles_.setFromTriplets(border.begin(), border.end());
  factor_ = std::make_unique<Eigen::SimplicialLDLT<SparseMatrix>>(matrix);
  const bool is_held = num_free == 0 || (factor_->info() == Eigen::Success &&
                                         factor_->vectorD().minCoeff() > 1e-9 * laplacian_.diagonal().mean());
  DAUMIER_CHECK(is_held, "a part of the mesh has no handle, or a vertex has no triangle");
}

std::vector<Eigen::Matrix3d> ArapDeformer::Rotations(const Points& moved) const {
  std::vector<Eigen::Matrix3d> rotations(size_t(rest_.rows()));
  for (int i = 0; i < laplacian_.outerSize(); ++i) {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (SparseMatrix::InnerIterator entry(laplacian_, i); entry; ++entry) {
      if (entry.row() == i) continue;
      moments -=
          entry.value() * (rest_.row(i) - rest_.row(entry.row())).transpose() * (moved.row(i) - moved.row(entry.row()));
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moments, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    if ((svd.matrixV() * svd.matrixU().transpose()).determinant() < 0) signs[2] = -1;
    rotations[size_t(i)] = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  }
  return rotations;
}

double ArapDeformer::Energy(const Points& moved, const std::vector<Eigen::Matrix3d>& rotations) const {
  double energy = 0;
  for (int i = 0; i < laplacian_.outerSize(); ++i) {
    for (SparseMatrix::InnerIterator entry(laplacian_, i); entry; ++entry) {
      if (entry.row() == i) continue;
      const Vector3 edge = (moved.row(i) - moved.row(entry.row())).transpose();
      const Vector3 rest = (rest_.row(i) - rest_.row(entry.row())).transpose();
      energy -= entry.value() * (edge - rotations[size_t(i)] * rest).squaredNorm();
    }
  }
  return energy;
}

ArapDeformation ArapDeformer::Solve(const Points& targets, int iterations, const Points& start) const {
  DAUMIER_CHECK(targets.rows() == std::ssize(handles_), "{} targets of {} handles", targets.rows(), handles_.size());
  DAUMIER_CHECK(targets.allFinite(), "a handle's target is not finite");
  DAUMIER_CHECK(start.rows() == 0 || start.rows() == rest_.rows(), "a start of {} vertices, expected {}", start.rows(),
                rest_.rows());
  ArapDeformation result{start.rows() > 0 ? start : rest_, {}};
  for (size_t k = 0; k < handles_.size(); ++k) result.vertices.row(handles_[k]) = targets.row(Eigen::Index(k));
  std::vector<Eigen::Matrix3d> rotations = Rotations(result.vertices);
  result.energies = {Energy(result.vertices, rotations)};
  for (int iteration = 0; iteration < iterations && !free_.empty(); ++iteration) {
    Points wanted = Points::Zero(rest_.rows(), 3);  // sum_j w_ij (R_i + R_j) / 2 (x_i - x_j)
    for (int i = 0; i < laplacian_.outerSize(); ++i) {
      for (SparseMatrix::InnerIterator entry(laplacian_, i); entry; ++entry) {
        if (entry.row() == i) continue;
        const Eigen::Matrix3d rotation = rotations[size_t(i)] + rotations[size_t(entry.row())];
        wanted.row(i) -=
            (entry.value() / 2 * rotation * (rest_.row(i) - rest_.row(entry.row())).transpose()).transpose();
      }
    }
    const Points right = wanted(free_, Eigen::all) - free_by_handles_ * targets;
    const Points moved = factor_->solve(right);
    for (size_t k = 0; k < free_.size(); ++k) result.vertices.row(free_[k]) = moved.row(Eigen::Index(k));
    rotations = Rotations(result.vertices);
    result.energies.push_back(Energy(result.vertices, rotations));
  }
  return result;
}

}  // namespace daumier::geometry
