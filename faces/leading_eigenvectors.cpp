#include "faces/leading_eigenvectors.h"

#include "core/error.h"
#include "geometry/symmetric_eigen.h"

#include <Spectra/MatOp/DenseSymMatProd.h>
#include <Spectra/SymEigsSolver.h>

namespace daumier::faces {
namespace {

/// Below this size, or where more than one in this many are wanted, all are found at once.
constexpr Eigen::Index kLeastSize = 2000, kLeastRatio = 20;

LeadingEigenvectors FromAll(const Eigen::MatrixXd& matrix, int count) {
  const geometry::SymmetricEigen eigen = geometry::DecomposeSymmetric(matrix);
  return {eigen.values.reverse().head(count), eigen.vectors.rowwise().reverse().leftCols(count)};
}

}  // namespace

LeadingEigenvectors FindLeadingEigenvectors(const Eigen::MatrixXd& matrix, int count) {
  DAUMIER_CHECK(count > 0 && count <= matrix.rows() && matrix.rows() == matrix.cols(),
                "{} eigenvectors of a matrix of {} x {}", count, matrix.rows(), matrix.cols());
  if (matrix.rows() < kLeastSize || matrix.rows() < kLeastRatio * count) return FromAll(matrix, count);
  Spectra::DenseSymMatProd<double> product(matrix);
  Spectra::SymEigsSolver<Spectra::DenseSymMatProd<double>> solver(product, count, 3 * count + 20);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) return FromAll(matrix, count);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace daumier::faces
