#include "eval/matrix_product.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::eval {
namespace {

template <class T>
class MatrixProduct : public ::testing::Test {
 protected:
  RowMajorMatrix<T> Random(Eigen::Index rows, Eigen::Index cols) {
    RowMajorMatrix<T> matrix(rows, cols);
    for (T& entry : matrix.reshaped()) entry = T(rng_.Normal());
    return matrix;
  }
  Eigen::Index Size(uint64_t most) { return Eigen::Index(rng_.Below(most + 1)); }

  /// Expects the sum over the inner index, computed in float64.
  template <class A, class B>
  void ExpectProduct(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
    const RowMajorMatrix<T> product = Product(a, b);
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(a.rows(), b.cols());
    // Eigen's own product of empty factors adds offsets to null pointers, which sanitizers refuse.
    if (a.size() > 0 && b.size() > 0) expected = a.template cast<double>().lazyProduct(b.template cast<double>());
    ASSERT_EQ(product.rows(), expected.rows());
    ASSERT_EQ(product.cols(), expected.cols());
    if (expected.size() == 0) return;
    const double tolerance = 20 * std::numeric_limits<T>::epsilon() * std::sqrt(double(a.cols()) + 1);
    ASSERT_LT((product.template cast<double>() - expected).cwiseAbs().maxCoeff(), tolerance)
        << a.rows() << " x " << a.cols() << " x " << b.cols();
  }

  Rng rng_{3};
};

using Types = ::testing::Types<float, double>;
TYPED_TEST_SUITE(MatrixProduct, Types);

TYPED_TEST(MatrixProduct, IsAsWorkedOutByHand) {
  const RowMajorMatrix<TypeParam> a = (RowMajorMatrix<TypeParam>(2, 3) << 1, 2, 3, 4, 5, 6).finished(),
                                  b = (RowMajorMatrix<TypeParam>(3, 1) << 1, 0, -1).finished();
  EXPECT_EQ(Product(a, b), (RowMajorMatrix<TypeParam>(2, 1) << -2, -2).finished());
}

TYPED_TEST(MatrixProduct, EqualsTheSumForEveryOrderOfBothMatrices) {
  using ColumnMajor = Eigen::Matrix<TypeParam, Eigen::Dynamic, Eigen::Dynamic>;
  for (int repeat = 0; repeat < 40; ++repeat) {
    const Eigen::Index m = this->Size(40), n = this->Size(40), k = this->Size(40);
    const RowMajorMatrix<TypeParam> a = this->Random(m, k), b = this->Random(k, n);
    const RowMajorMatrix<TypeParam> a_transposed = a.transpose(), b_transposed = b.transpose();
    const ColumnMajor a_columns = a, b_columns = b;
    this->ExpectProduct(a, b);
    this->ExpectProduct(a_transposed.transpose(), b);
    this->ExpectProduct(a, b_transposed.transpose());
    this->ExpectProduct(a_transposed.transpose(), b_transposed.transpose());
    this->ExpectProduct(a_columns, b_columns);
    this->ExpectProduct(a_columns, b_transposed.transpose());
  }
}

TYPED_TEST(MatrixProduct, ReadsBlocksOfLargerMatrices) {
  const RowMajorMatrix<TypeParam> a = this->Random(30, 41), b = this->Random(50, 37);
  this->ExpectProduct(a.block(3, 5, 20, 17), b.block(4, 9, 17, 25));
  this->ExpectProduct(a.block(3, 5, 20, 17).transpose(), b.block(4, 9, 20, 25));
  this->ExpectProduct(a.block(3, 5, 20, 17), b.block(4, 9, 25, 17).transpose());
  this->ExpectProduct(a.middleRows(2, 1), b.topRows(41));
  this->ExpectProduct(a.row(2), b.topRows(41));
  this->ExpectProduct(a.col(4).eval(), b.row(7));
  const Eigen::Map<const RowMajorMatrix<TypeParam>, 0, Eigen::OuterStride<>> map(b.data(), 4, 41,
                                                                                 Eigen::OuterStride<>(60));
  this->ExpectProduct(map, a.transpose());
}

TYPED_TEST(MatrixProduct, OfEmptyMatricesIsEmptyAndOverAnEmptyInnerIndexZero) {
  this->ExpectProduct(RowMajorMatrix<TypeParam>(0, 3), RowMajorMatrix<TypeParam>(3, 2));
  this->ExpectProduct(RowMajorMatrix<TypeParam>(2, 3), RowMajorMatrix<TypeParam>(3, 0));
  this->ExpectProduct(RowMajorMatrix<TypeParam>(2, 0), RowMajorMatrix<TypeParam>(0, 4));
  this->ExpectProduct(RowMajorMatrix<TypeParam>(0, 2).transpose(), RowMajorMatrix<TypeParam>(0, 4));
}

TYPED_TEST(MatrixProduct, IsAddedWithItsFactor) {
  const RowMajorMatrix<TypeParam> a = this->Random(7, 5), b = this->Random(7, 9), start = this->Random(5, 9);
  RowMajorMatrix<TypeParam> sum = start;
  AddProduct(TypeParam(0.5), a.transpose(), b, sum);
  const RowMajorMatrix<TypeParam> expected = start + TypeParam(0.5) * a.transpose().lazyProduct(b);
  EXPECT_LT((sum - expected).cwiseAbs().maxCoeff(), TypeParam(1e-5));
}

TYPED_TEST(MatrixProduct, DoesNotReadTheResultWhereItIsReplaced) {
  const RowMajorMatrix<TypeParam> a = this->Random(3, 3);
  RowMajorMatrix<TypeParam> c = RowMajorMatrix<TypeParam>::Constant(3, 3, std::numeric_limits<TypeParam>::quiet_NaN());
  MultiplyAdd<TypeParam>(1, ViewOf(a), ViewOf(a), 0, c.data());
  EXPECT_EQ(c, Product(a, a));
  c.setConstant(std::numeric_limits<TypeParam>::quiet_NaN());
  MultiplyAdd<TypeParam>(1, ViewOf(a.leftCols(0)), ViewOf(a.topRows(0)), 0, c.data());
  EXPECT_TRUE(c.isZero(0));
}

TYPED_TEST(MatrixProduct, RefusesSizesAndStridesThatDoNotFit) {
  const RowMajorMatrix<TypeParam> a = this->Random(3, 4);
  testing::ExpectError([&] { Product(a, a); }, "a 3 x 4 matrix cannot be multiplied by a 3 x 4 one");
  testing::ExpectError([&] { Product(a, a.row(0).transpose().reverse().eval().transpose()); }, "cannot be multiplied");
  testing::ExpectError([&] { Product(a.col(1).transpose(), a); }, "neighbouring entries are 4 apart");
  RowMajorMatrix<TypeParam> sum(3, 4);
  testing::ExpectError([&] { AddProduct(TypeParam(1), a, a.transpose(), sum); }, "the sum is 3 x 4, the product 3 x 3");
  MatrixView<TypeParam> overlapping = ViewOf(a);
  overlapping.stride = 2;
  testing::ExpectError([&] { MultiplyAdd<TypeParam>(1, overlapping, ViewOf(a.transpose()), 0, sum.data()); },
                       "a stride of 2");
}

}  // namespace
}  // namespace daumier::eval
