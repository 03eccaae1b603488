#include "tensor/eigen.h"

#include "tests/support/expect_error.h"

#include <torch/types.h>

namespace daumier::tensor {
namespace {

TEST(EigenBridge, ViewsShareMemoryInBothLayouts) {
  RowMajorMatrix<float> rows(2, 3);
  rows << 1, 2, 3, 4, 5, 6;
  Eigen::MatrixXf columns = rows;
  const auto of_rows = ViewAsTensor(rows), of_columns = ViewAsTensor(columns);
  EXPECT_TRUE(of_rows.is_contiguous());
  EXPECT_EQ(of_columns.strides().vec(), (std::vector<int64_t>{1, 2}));
  EXPECT_TRUE(torch::equal(of_rows, of_columns));
  EXPECT_EQ(of_columns[1][0].item<float>(), 4.0f);
  rows(1, 2) = -1;
  EXPECT_EQ(of_rows[1][2].item<float>(), -1.0f);
}

TEST(EigenBridge, CopiesAreIndependentAndContiguous) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Random(3, 2);
  const auto copy = CopyToTensor(matrix);
  const double before = matrix(2, 1);
  matrix(2, 1) = 9;
  EXPECT_TRUE(copy.is_contiguous());
  EXPECT_EQ(copy.scalar_type(), torch::kFloat64);
  EXPECT_EQ(copy[2][1].item<double>(), before);
}

TEST(EigenBridge, CopiesExpressionsAndVectors) {
  const Eigen::Vector3i vector(1, 2, 3);
  EXPECT_TRUE(torch::equal(CopyToTensor(vector), torch::tensor({1, 2, 3}, torch::kInt32)));
  EXPECT_TRUE(torch::equal(CopyToTensor(vector.transpose()), torch::tensor({1, 2, 3}, torch::kInt32)));
  EXPECT_TRUE(torch::equal(CopyToTensor(2 * Eigen::Matrix2f::Identity()), 2 * torch::eye(2)));
}

TEST(EigenBridge, MatrixAndTensorRoundTrip) {
  const auto tensor = torch::arange(6, torch::kFloat32).view({2, 3});
  EXPECT_TRUE(torch::equal(CopyToTensor(ViewAsMatrix<float>(tensor)), tensor));
  EXPECT_EQ(ViewAsMatrix<float>(tensor).data(), tensor.data_ptr<float>());
  EXPECT_EQ(CopyToMatrix<double>(tensor.t())(2, 1), 5.0);
}

TEST(EigenBridge, RefusesViewsOfOtherLayoutsAndTypes) {
  const auto tensor = torch::zeros({2, 3});
  testing::ExpectError([&] { ViewAsMatrix<float>(tensor.t()); }, "contiguous");
  testing::ExpectError([&] { ViewAsMatrix<double>(tensor); }, "Float");
  testing::ExpectError([&] { CopyToMatrix<float>(tensor[0]); }, "expected (*, *)");
}

}  // namespace
}  // namespace daumier::tensor
