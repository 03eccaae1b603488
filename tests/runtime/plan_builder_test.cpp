#include "runtime/plan_builder.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

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

TEST(PlanBuilder, PartsOfAConcatenationAreWrittenInPlace) {
  const GraphExample example = GraphExample({1, 2, 3, 3})
                                   .Node("Relu", {"x"}, "a")
                                   .Node("Sigmoid", {"x"}, "b")
                                   .Node("Concat", {"a", "b"}, "y", {{"axis", int64_t(1)}});
  PackedWeights packed;
  const auto plan = PlanBuilder(example.graph, {{"x", {1, 2, 3, 3}}}, packed).Build();
  EXPECT_EQ(plan->steps().size(), 2u) << "two functions, and nothing is copied";
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
