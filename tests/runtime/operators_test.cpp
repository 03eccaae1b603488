#include "runtime/operators.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

TEST(RuntimeOperators, EachPartOfTheTableIsFoundByName) {
  for (const OperatorTable& table :
       {LayerOperators(), ImageOperators(), NormOperators(), PointwiseOperators(), RearrangingOperators(),
        ReductionOperators(), ResizingOperators(), ShapeOperators()}) {
    EXPECT_FALSE(table.empty());
    for (const auto& [name, plan] : table) {
      EXPECT_EQ(OperatorOf({.op = name, .name = name}), plan) << name;
      EXPECT_TRUE(IsRunHere(name)) << name;
    }
  }
}

TEST(RuntimeOperators, AnUnknownOneIsRefused) {
  testing::ExpectError([] { OperatorOf({.op = "FlyToTheMoon", .name = "n"}); }, "the operator is not run here");
  EXPECT_FALSE(IsRunHere("FlyToTheMoon"));
  EXPECT_TRUE(IsRunHere("Shape"));
  testing::ExpectError([] { OperatorOf({.op = "Range", .name = "n"}); }, "on what depends on the inputs' numbers");
}

TEST(RuntimeOperators, AWindowDecidesTheSizeOfTheOutput) {
  // (5 + 1 + 1 - 3) / 2 + 1 = 3, and with dilation 2 of a kernel that then covers five: (5 + 2 - 5) / 1 + 1 = 3.
  EXPECT_EQ(WindowOutput({1, 8, 5, 5}, 4, {{3, 3}, {2, 1}, {1, 2}, {1, 1}, {1, 1}}), (Shape{1, 4, 3, 3}));
  EXPECT_THROW(WindowOutput({1, 8, 2, 2}, 4, {{3, 3}, {1, 1}, {1, 1}, {0, 0}, {0, 0}}), Error);
}

TEST(RuntimeOperators, AutoPadKeepsTheSizeDividedByTheStrides) {
  const auto window = [](const std::string& auto_pad, int64_t kernel) {
    const GraphNode node{.op = "Conv", .attributes = {{"auto_pad", auto_pad}, {"strides", std::vector<int64_t>{2, 2}}}};
    return WindowOf(node, {kernel, kernel}, {1, 3, 5, 6});
  };
  // 5 pixels by 2: 3, which 4 x 2 windows reach: (3 - 1) 2 + 4 - 5 = 3 pads; 6 pixels: 2 x 2 + 4 - 6 = 2.
  EXPECT_EQ(window("SAME_UPPER", 4).before, (std::vector<int64_t>{1, 1}));
  EXPECT_EQ(window("SAME_UPPER", 4).after, (std::vector<int64_t>{2, 1}));
  EXPECT_EQ(window("SAME_LOWER", 4).before, (std::vector<int64_t>{2, 1}));
  EXPECT_EQ(window("SAME_UPPER", 1).after, (std::vector<int64_t>{0, 0}));
  EXPECT_EQ(window("VALID", 4).after, (std::vector<int64_t>{0, 0}));
  testing::ExpectError([&] { window("SIDEWAYS", 3); }, "there is no auto_pad 'SIDEWAYS'");
}

}  // namespace
}  // namespace daumier::runtime
