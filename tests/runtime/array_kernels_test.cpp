#include "runtime/array_kernels.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::runtime {
namespace {

using Floats = std::vector<float>;

TEST(ArrayKernels, StridesOfAPlainArrayAreProductsOfTheInnerSizes) {
  EXPECT_EQ(StridesOf({2, 3, 4}), (std::vector<int64_t>{12, 4, 1}));
  EXPECT_EQ(RepeatingStrides({3, 1}, {2, 3, 4}), (std::vector<int64_t>{0, 1, 0}));
}

TEST(ArrayKernels, StridedCopyTransposes) {
  const Floats from = {0, 1, 2, 3, 4, 5};  // 2 x 3
  Floats to(6);
  StridedCopy({3, 2}, {1, 3}, StridesOf({3, 2})).Run(from.data(), to.data());
  EXPECT_EQ(to, (Floats{0, 3, 1, 4, 2, 5}));
}

TEST(ArrayKernels, BroadcastFunctionRepeatsAxesOfSizeOne) {
  const Floats column = {1, 2}, row = {10, 20, 30};
  Floats sum(6);
  BroadcastFunction("Add", {2, 1}, {1, 3}, {2, 3}).Run(column.data(), row.data(), sum.data());
  EXPECT_EQ(sum, (Floats{11, 21, 31, 12, 22, 32}));
  const Floats x = {-2, 4}, slopes = {0.5f};
  Floats y(2);
  BroadcastFunction("PRelu", {2}, {1}, {2}).Run(x.data(), slopes.data(), y.data());
  EXPECT_EQ(y, (Floats{-1, 4}));
}

TEST(ArrayKernels, BroadcastFunctionRefusesAnUnknownOne) {
  EXPECT_THROW(BroadcastFunction("Modulo", {1}, {1}, {1}), Error);
}

TEST(ArrayKernels, StridedReductionReducesTheNamedAxes) {
  const Floats from = {1, 2, 3, 4, 5, 9};  // 2 x 3, reduced over its rows.
  Floats to(3);
  const auto reduce = [&](Reduction kind) {
    StridedReduction(kind, {3}, {1}, {2}, {3}).Run(from.data(), to.data());
    return to;
  };
  EXPECT_EQ(reduce(Reduction::kMean), (Floats{2.5f, 3.5f, 6}));
  EXPECT_EQ(reduce(Reduction::kMax), (Floats{4, 5, 9}));
  EXPECT_EQ(reduce(Reduction::kMin), (Floats{1, 2, 3}));
}

TEST(ArrayKernels, SoftmaxSumsToOneAlongItsAxisAndDoesNotOverflow) {
  const Floats from = {1000, 0, 1000, std::log(3.0f)};  // outer 1, size 2, inner 2
  Floats to(4);
  SoftmaxOf(from.data(), 1, 2, 2, false, to.data());
  EXPECT_NEAR(to[0], 0.5, 1e-6);
  EXPECT_NEAR(to[2], 0.5, 1e-6);
  EXPECT_NEAR(to[1], 0.25, 1e-6);
  EXPECT_NEAR(to[3], 0.75, 1e-6);
  SoftmaxOf(from.data(), 1, 2, 2, true, to.data());
  EXPECT_NEAR(to[3], std::log(0.75), 1e-6);
}

}  // namespace
}  // namespace daumier::runtime
