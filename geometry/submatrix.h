#pragma once
#include "geometry/operators.h"

#include <vector>

namespace daumier::geometry {

/// The entries of a matrix in chosen rows and columns. row_of: the place of each row, -1 where it is left out. columns: the
/// chosen ones, in the order of their places. @throws Error if there are not as many places as rows.
SparseMatrix Submatrix(const SparseMatrix& matrix, const std::vector<int>& row_of, Eigen::Index num_rows,
                       const std::vector<int>& columns);

}  // namespace daumier::geometry
