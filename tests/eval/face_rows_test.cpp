#include "eval/face_rows.h"

#include <gtest/gtest.h>

#include <vector>

namespace daumier::eval {
namespace {

TEST(RowsOnAllCores, KeepsTheOrderOfRowsWhateverHoldsThem) {
  const FaceRows expected = (FaceRows(3, 2) << 0, 1, 10, 11, 20, 21).finished();
  EXPECT_EQ(RowsOnAllCores(3, 2,
                           [](int i) {
                             return std::vector<float>{10.0f * float(i), 10.0f * float(i) + 1};
                           }),
            expected);
  EXPECT_EQ(RowsOnAllCores(
                3, 2, [](int i) { return Eigen::VectorXf(Eigen::Vector2f(10.0f * float(i), 10.0f * float(i) + 1)); }),
            expected);
  EXPECT_EQ(RowSpan(expected, 1)[1], 11);
}

}  // namespace
}  // namespace daumier::eval
