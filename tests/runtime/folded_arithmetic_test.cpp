#include "runtime/folded_arithmetic.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::runtime {
namespace {

GraphTensor Integer(int64_t number) {
  return {.integers = {number}, .has_integers = true};
}
GraphTensor Real(float number) {
  return {.numbers = {number}};
}

TEST(FoldedArithmetic, RestsHaveTheSignOfTheDivisor) {
  const auto rest = [](int64_t a, int64_t b) { return FoldedBinary("Mod", Integer(a), Integer(b))->integers[0]; };
  EXPECT_EQ(rest(7, 3), 1);
  EXPECT_EQ(rest(-7, 3), 2);
  EXPECT_EQ(rest(7, -3), -2);
  EXPECT_EQ(rest(-7, -3), -1);
}

TEST(FoldedArithmetic, ComparisonsGiveZeroAndOne) {
  for (const auto& [f, results] : std::map<std::string, std::vector<int64_t>>{{"Less", {1, 0, 0}},
                                                                              {"LessOrEqual", {1, 1, 0}},
                                                                              {"Equal", {0, 1, 0}},
                                                                              {"GreaterOrEqual", {0, 1, 1}},
                                                                              {"Greater", {0, 0, 1}}}) {
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(FoldedBinary(f, Integer(int64_t(i)), Integer(1))->integers[0], results[i]) << f;
      EXPECT_EQ(FoldedBinary(f, Real(float(i)), Real(1))->integers[0], results[i]) << f;
    }
  }
}

TEST(FoldedArithmetic, KnowsItsOperators) {
  const std::vector<std::string> names = FoldedArithmeticNames();
  EXPECT_TRUE(std::ranges::count(names, "Cast") > 0 && std::ranges::count(names, "Mod") > 0);
  EXPECT_FALSE(FoldedBinary("Pow", Integer(2), Integer(3)).has_value());
  EXPECT_FALSE(FoldedUnary({.op = "Floor"}, Integer(2)).has_value());
}

TEST(FoldedArithmetic, RangesEndBeforeTheirEnd) {
  EXPECT_EQ(FoldedRange(Integer(0), Integer(5), Integer(2), 9)->integers, (std::vector<int64_t>{0, 2, 4}));
  EXPECT_EQ(FoldedRange(Real(1), Real(0), Real(-0.5f), 9)->numbers, (std::vector<float>{1, 0.5f}));
  EXPECT_TRUE(FoldedRange(Integer(3), Integer(0), Integer(1), 9)->integers.empty());
  EXPECT_FALSE(FoldedRange(Integer(0), Integer(10), Integer(1), 9).has_value());
}

TEST(FoldedArithmetic, IndicesCountFromTheEndWhereNegative) {
  EXPECT_EQ(IndicesOf({0, -1}, 3), (std::vector<int64_t>{0, 2}));
  testing::ExpectError([] { IndicesOf({3}, 3); }, "there is no index 3 of 3");
  testing::ExpectError([] { IndicesOf({-4}, 3); }, "there is no index -4 of 3");
}

TEST(FoldedArithmetic, ReducesAllNumbers) {
  const GraphTensor three{.shape = {3}, .integers = {2, -3, 4}, .has_integers = true};
  EXPECT_EQ(FoldedReduction("ReduceSum", three).integers[0], 3);
  EXPECT_EQ(FoldedReduction("ReduceProd", three).integers[0], -24);
  EXPECT_EQ(FoldedReduction("ReduceMax", three).integers[0], 4);
  EXPECT_EQ(FoldedReduction("ReduceMin", three).integers[0], -3);
}

}  // namespace
}  // namespace daumier::runtime
