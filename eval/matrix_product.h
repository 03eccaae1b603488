#pragma once
#include "core/error.h"

#include <Eigen/Core>

/// Products of dense matrices through the program's BLAS: float by sgemm_ (oneDNN's in a program of ours), double by
/// dgemm_ (the system's). Both are several times faster than Eigen's, which is compiled without AVX here.
namespace daumier::eval {

template <class T>
using RowMajorMatrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Entry (i, j) is data[i * stride + j] if row_major, else data[i + j * stride].
template <class T>
struct MatrixView {
  const T* data;
  Eigen::Index rows, cols, stride;
  bool row_major;
};

/// View of a matrix, a Map, or a block or transpose of them. @throws Error if neither rows nor columns are contiguous.
template <class Derived>
MatrixView<typename Derived::Scalar> ViewOf(const Eigen::MatrixBase<Derived>& matrix) {
  static_assert(bool(Derived::Flags & Eigen::DirectAccessBit), "an operand of a product must lie in memory");
  const Derived& m = matrix.derived();
  DAUMIER_CHECK(m.innerStride() == 1 || m.innerSize() <= 1, "neighbouring entries are {} apart, expected 1",
                m.innerStride());
  return {m.data(), m.rows(), m.cols(), m.outerStride(), bool(Derived::IsRowMajor)};
}

/// C = alpha A B + beta C; C is row-major and contiguous, and not read where beta is 0. T is float or double.
/// A and B may overlap each other, but not C. @throws Error if the inner sizes differ.
template <class T>
void MultiplyAdd(T alpha, const MatrixView<T>& a, const MatrixView<T>& b, T beta, T* c);

/// A B.
template <class A, class B>
RowMajorMatrix<typename A::Scalar> Product(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  using T = typename A::Scalar;
  RowMajorMatrix<T> c(a.rows(), b.cols());
  MultiplyAdd<T>(1, ViewOf(a), ViewOf(b), 0, c.data());
  return c;
}

/// C += alpha A B. @throws Error also if C has another size than A B.
template <class A, class B>
void AddProduct(typename A::Scalar alpha, const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b,
                RowMajorMatrix<typename A::Scalar>& c) {
  DAUMIER_CHECK(c.rows() == a.rows() && c.cols() == b.cols(), "the sum is {} x {}, the product {} x {}", c.rows(),
                c.cols(), a.rows(), b.cols());
  MultiplyAdd<typename A::Scalar>(alpha, ViewOf(a), ViewOf(b), 1, c.data());
}

}  // namespace daumier::eval
