#include "geometry/submatrix.h"

#include "core/error.h"

namespace daumier::geometry {

SparseMatrix Submatrix(const SparseMatrix& matrix, const std::vector<int>& row_of, Eigen::Index num_rows,
                       const std::vector<int>& columns) {
  DAUMIER_CHECK(std::ssize(row_of) == matrix.rows(), "{} places for {} rows", row_of.size(), matrix.rows());
  std::vector<Eigen::Triplet<double>> triplets;
  for (size_t column = 0; column < columns.size(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, columns[column]); entry; ++entry)
      if (const int row = row_of[size_t(entry.row())]; row >= 0) triplets.emplace_back(row, int(column), entry.value());
  SparseMatrix submatrix(num_rows, Eigen::Index(columns.size()));
  submatrix.setFromTriplets(triplets.begin(), triplets.end());
  return submatrix;
}

}  // namespace daumier::geometry
