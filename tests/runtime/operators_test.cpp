#include "runtime/operators.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

TEST(RuntimeOperators, EachPartOfTheTableIsFoundByName) {
  for (const OperatorTable& table :
       {LayerOperators(), ImageOperators(), PointwiseOperators(), ShapeOperators(), ReductionOperators()}) {
    EXPECT_FALSE(table.empty());
    for (const auto& [name, plan] : table) EXPECT_EQ(OperatorOf({.op = name, .name = name}), plan) << name;
  }
}

TEST(RuntimeOperators, AnUnknownOneIsRefused) {
  testing::ExpectError([] { OperatorOf({.op = "FlyToTheMoon", .name = "n"}); }, "the operator is not run here");
}

TEST(RuntimeOperators, ShapesRepeatAlongAxesOfSizeOne) {
  EXPECT_EQ(BroadcastShape({2, 1, 4}, {3, 1}), (Shape{2, 3, 4}));
  EXPECT_THROW(BroadcastShape({2, 3}, {4, 3}), Error);
}

TEST(RuntimeOperators, AxesCountFromTheEndWhereNegative) {
  EXPECT_EQ(AxisOf(-1, 4), 3u);
  EXPECT_EQ(AxisOf(2, 4), 2u);
  EXPECT_THROW(AxisOf(4, 4), Error);
  EXPECT_THROW(AxisOf(-5, 4), Error);
}

TEST(RuntimeOperators, AWindowDecidesTheSizeOfTheOutput) {
  // (5 + 1 + 1 - 3) / 2 + 1 = 3, and with dilation 2 of a kernel that then covers five: (5 + 2 - 5) / 1 + 1 = 3.
  EXPECT_EQ(WindowOutput({1, 8, 5, 5}, 4, {{3, 3}, {2, 1}, {1, 2}, {1, 1}, {1, 1}}), (Shape{1, 4, 3, 3}));
  EXPECT_THROW(WindowOutput({1, 8, 2, 2}, 4, {{3, 3}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}), Error);
}

}  // namespace
}  // namespace daumier::runtime
