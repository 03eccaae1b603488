#include "geometry/symmetric_eigen.h"

#include "core/error.h"

#include <Eigen/Eigenvalues>

namespace daumier::geometry {
namespace {

using SymmetricSolver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

SymmetricSolver Solve(const Eigen::MatrixXd& matrix, int options) {
  DAUMIER_CHECK(matrix.rows() == matrix.cols(), "a matrix of {} x {} is not symmetric", matrix.rows(), matrix.cols());
  SymmetricSolver solver(matrix, options);
  DAUMIER_CHECK(solver.info() == Eigen::Success && solver.eigenvalues().allFinite(),
                "the eigenvalues of a {} x {} matrix do not converge", matrix.rows(), matrix.cols());
  return solver;
}

}  // namespace

SymmetricEigen DecomposeSymmetric(const Eigen::MatrixXd& matrix) {
  const SymmetricSolver solver = Solve(matrix, Eigen::ComputeEigenvectors);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd SymmetricEigenvalues(const Eigen::MatrixXd& matrix) {
  return Solve(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace daumier::geometry
