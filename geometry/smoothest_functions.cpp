#include "geometry/smoothest_functions.h"

#include "core/error.h"
#include "geometry/normals.h"
#include "geometry/operators.h"

#include <Eigen/SparseCholesky>

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace daumier::geometry {
namespace {

/// x -> (D (L + shift A) D)^-1 x with D = A^-1/2, as Spectra wants operators.
class InverseOfLaplacian {
 public:
  using Scalar = double;
  explicit InverseOfLaplacian(const SparseMatrix& matrix) : size_(matrix.rows()), factor_(matrix) {
    DAUMIER_CHECK(factor_.info() == Eigen::Success, "the Laplacian of the surface has no Cholesky factor");
  }
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, size_) = factor_.solve(Eigen::Map<const Eigen::VectorXd>(in, size_));
  }

 private:
  Eigen::Index size_;
  Eigen::SimplicialLDLT<SparseMatrix> factor_;
};

constexpr double kShift = 0.02;  // In units of 1 / area of the surface.

}  // namespace

SmoothestFunctions FindSmoothestFunctions(const TriangleMesh& mesh, int count) {
  const Eigen::VectorXd all_areas = VertexAreas(mesh);
  std::vector<int> used;
  std::vector<int> row(size_t(mesh.vertices.rows()), -1);
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    if (all_areas[v] <= 0) continue;
    row[size_t(v)] = static_cast<int>(used.size());
    used.push_back(v);
  }
  const auto size = static_cast<Eigen::Index>(used.size());
  DAUMIER_CHECK(count > 0 && count + 1 < size, "{} functions of a surface of {} vertices", count, size);
  const Eigen::VectorXd areas = all_areas(used), root = areas.cwiseSqrt();
  const double total = areas.sum(), shift = kShift / total;

  const SparseMatrix laplacian = CotangentLaplacian(mesh);
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < laplacian.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it) {
      const int i = row[size_t(it.row())], j = row[size_t(it.col())];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, it.value() / (root[i] * root[j]));
    }
  }
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, shift);
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());

  InverseOfLaplacian inverse(matrix);
  const Eigen::Index subspace = std::min<Eigen::Index>(size, 3 * (count + 1) + 20);
  Spectra::SymEigsSolver<InverseOfLaplacian> solver(inverse, count + 1, subspace);
  solver.init();
  solver.compute(Spectra::SortRule::LargestAlge);
  DAUMIER_CHECK(solver.info() == Spectra::CompInfo::Successful,
                "the {} smoothest functions of a surface do not converge", count);
  SmoothestFunctions found{solver.eigenvalues().tail(count).cwiseInverse().array() - shift,
                           Eigen::MatrixXd::Zero(mesh.vertices.rows(), count)};
  const Eigen::MatrixXd vectors = solver.eigenvectors().rightCols(count);
  for (int k = 0; k < count; ++k) {
    Eigen::VectorXd function = std::sqrt(total) * vectors.col(k).cwiseQuotient(root);
    // The first of those that a mirror image makes equal.
    const double great = 0.999 * function.cwiseAbs().maxCoeff();
    const auto first = std::find_if(function.begin(), function.end(), [&](double f) { return std::abs(f) >= great; });
    if (*first < 0) function = -function;
    found.functions(used, k) = function;
  }
  return found;
}

}  // namespace daumier::geometry
