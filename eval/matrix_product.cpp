#include "eval/matrix_product.h"

#include "core/sgemm.h"

#include <algorithm>
#include <limits>

extern "C" {
daumier::Sgemm sgemm_;
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*,
            const double*, const int*, const double*, double*, const int*);
}

namespace daumier::eval {
namespace {

int BlasSize(Eigen::Index size) {
  DAUMIER_CHECK(size <= std::numeric_limits<int>::max(), "a matrix has a size of {}, BLAS takes at most {}", size,
                std::numeric_limits<int>::max());
  return int(size);
}

/// Distance of the rows or columns that are contiguous. That of a single one has no meaning.
template <class T>
int LeadingDimension(const MatrixView<T>& m) {
  const Eigen::Index inner = m.row_major ? m.cols : m.rows, outer = m.row_major ? m.rows : m.cols;
  DAUMIER_CHECK(outer <= 1 || m.stride >= inner, "a {} x {} matrix has a stride of {}", m.rows, m.cols, m.stride);
  return BlasSize(std::max(m.stride, std::max<Eigen::Index>(inner, 1)));
}

}  // namespace

template <class T>
void MultiplyAdd(T alpha, const MatrixView<T>& a, const MatrixView<T>& b, T beta, T* c) {
  DAUMIER_CHECK(a.cols == b.rows, "a {} x {} matrix cannot be multiplied by a {} x {} one", a.rows, a.cols, b.rows,
                b.cols);
  if (a.rows == 0 || b.cols == 0) return;
  // Fortran's matrices are column-major: C^T = B^T A^T, where a row-major B is B^T already.
  const char op_b = b.row_major ? 'N' : 'T', op_a = a.row_major ? 'N' : 'T';
  const int m = BlasSize(b.cols), n = BlasSize(a.rows), k = BlasSize(a.cols);
  const int ldb = LeadingDimension(b), lda = LeadingDimension(a);
  if constexpr (std::is_same_v<T, float>) {
    sgemm_(&op_b, &op_a, &m, &n, &k, &alpha, b.data, &ldb, a.data, &lda, &beta, c, &m);
  } else {
    dgemm_(&op_b, &op_a, &m, &n, &k, &alpha, b.data, &ldb, a.data, &lda, &beta, c, &m);
  }
}

template void MultiplyAdd<float>(float, const MatrixView<float>&, const MatrixView<float>&, float, float*);
template void MultiplyAdd<double>(double, const MatrixView<double>&, const MatrixView<double>&, double, double*);

}  // namespace daumier::eval
