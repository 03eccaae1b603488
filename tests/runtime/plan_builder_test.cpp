#include "runtime/plan_builder.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <algorithm>
#include <cmath>

namespace daumier::runtime {
namespace {

TEST(PlanBuilder, PacksAWeightOncePerLayout) {
  PackedWeights packed;
  const std::vector<float> weights = FixedNumbers(16 * 16 * 2);
  const Layout plain = PlainLayout({16, 16, 2, 1}), blocked = BlockedLayout({16, 16, 2, 1}, 8);
  const float* const first = packed.Packed("w", weights.data(), plain, blocked);
  EXPECT_EQ(packed.Packed("w", weights.data(), plain, blocked), first);
  EXPECT_NE(packed.Packed("w", weights.data(), plain, plain), first);
  EXPECT_FLOAT_EQ(first[1], weights[2]) << "the second channel of the first pixel comes next";
}

TEST(PlanBuilder, AConcatenationHoldsItsParts) {
  const GraphExample example = GraphExample({1, 2, 3, 3})
                                   .Node("Relu", {"x"}, "a")
                                   .Node("Sigmoid", {"x"}, "b")
                                   .Node("Concat", {"a", "b"}, "y", {{"axis", int64_t(1)}});
  PackedWeights packed;
  const FloatArray x = FixedArray({1, 2, 3, 3});
  const FloatArray y = PlanBuilder(example.graph, {{"x", x.shape}}, packed).Build()->Run({{"x", x}}).at("y");
  ASSERT_EQ(y.shape, (Shape{1, 4, 3, 3}));
  for (size_t i = 0; i < x.values.size(); ++i) {
    EXPECT_EQ(y.values[i], std::max(x.values[i], 0.0f));
    EXPECT_NEAR(y.values[x.values.size() + i], 1 / (1 + std::exp(-x.values[i])), 1e-6);
  }
}

TEST(PlanBuilder, NamesTheNodeThatItRefuses) {
  const GraphExample example = GraphExample({1, 2}).Weight("w", {3, 1}, {1, 2, 3}).Node("MatMul", {"x", "w"}, "y");
  testing::ExpectError(
      [&] {
        PackedWeights packed;
        PlanBuilder(example.graph, {{"x", {1, 2}}}, packed).Build();
      },
      "MatMul_y");
}

TEST(PlanBuilder, NamesANodeWithTooFewInputs) {
  const GraphExample example = GraphExample({1, 2}).Node("MatMul", {"x"}, "y");
  testing::ExpectError([&] { example.Run(FixedArray({1, 2})); }, "node 'MatMul_y' (MatMul) has 1 inputs");
}

}  // namespace
}  // namespace daumier::runtime
