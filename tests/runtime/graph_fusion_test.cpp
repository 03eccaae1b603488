#include "runtime/graph_fusion.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <algorithm>

namespace daumier::runtime {
namespace {

const std::map<std::string, GraphAttribute> kSame = {{"pads", std::vector<int64_t>{1, 1, 1, 1}}};

/// A residual block, [conv, norm, ReLU, conv, norm] + x, ReLU, whose sums `outputs` may hold on to.
GraphExample ResidualExample(std::vector<std::string> outputs = {"y"}) {
  GraphExample example({-1, 12, 6, 6}, std::move(outputs));
  std::string from = "x";
  for (const char* name : {"a", "b"}) {
    const std::string n = name;
    example.Weight(n + "w", {12, 12, 3, 3}, FixedNumbers(12 * 12 * 9, uint32_t(n[0])));
    example.Weight(n + "s", {12}, FixedNumbers(12, 3)).Weight(n + "t", {12}, FixedNumbers(12, 4));
    example.Weight(n + "m", {12}, FixedNumbers(12, 5)).Weight(n + "v", {12}, std::vector<float>(12, 0.3f));
    example.Node("Conv", {from, n + "w"}, n + "c", kSame);
    example.Node("BatchNormalization", {n + "c", n + "s", n + "t", n + "m", n + "v"}, n + "n");
    from = n == "a" ? "r" : "";
    if (n == "a") example.Node("Relu", {"an"}, "r");
  }
  return example.Node("Add", {"bn", "x"}, "s").Node("Relu", {"s"}, "o").Node("Identity", {"o"}, "y");
}

TEST(Fused, AResidualBlockIsTwoConvolutions) {
  const Graph graph = Fused(ResidualExample().graph);
  ASSERT_EQ(graph.nodes.size(), 2u);
  EXPECT_EQ(graph.nodes[0].Text(kActivation, ""), "Relu");
  EXPECT_EQ(graph.nodes[1].inputs[kAddend], "x");
  EXPECT_EQ(graph.nodes[1].output, "y");
  EXPECT_EQ(graph.weights.size(), 4u);  // Of two convolutions and their biases.
  EXPECT_NO_THROW(CheckGraph(graph));
}

TEST(Fused, KeepsTheFunction) {
  for (const int64_t batch : {1, 2}) {
    const FloatArray x = FixedArray({batch, 12, 6, 6}, 9);
    // Values that are outputs vanish in no fusion.
    const NamedArrays apart = GraphRunner(ResidualExample({"ac", "an", "bc", "bn", "s", "y"}).graph).Run({{"x", x}});
    ExpectNear(ResidualExample().Run(x), apart.at("y"), 1e-6);
    FloatArray sum = apart.at("bn");
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] = std::max(0.0f, sum.values[i] + x.values[i]);
    ExpectNear(apart.at("y"), sum, 1e-6);
  }
}

TEST(Fused, LeavesValuesThatOthersRead) {
  GraphExample example({-1, 1, 4, 4});
  example.Weight("w", {1, 1, 3, 3}, FixedNumbers(9)).Node("Conv", {"x", "w"}, "c", kSame).Node("Relu", {"c"}, "r");
  example.Node("Mul", {"c", "r"}, "y");
  EXPECT_EQ(Fused(example.graph).nodes.size(), 3u);
}

TEST(Fused, RefusesABatchNormOfNegativeVariance) {
  GraphExample example({-1, 1, 4, 4});
  example.Weight("w", {1, 1, 3, 3}, FixedNumbers(9)).Node("Conv", {"x", "w"}, "c", kSame).Weight("s", {1}, {1});
  example.Weight("v", {1}, {-1}).Node("BatchNormalization", {"c", "s", "s", "s", "v"}, "y");
  testing::ExpectError([&] { Fused(example.graph); }, "makes numbers that are not finite");
}

/// PyTorch's group norm: x seen as two groups, normalised, seen as x, times scale plus shift; `outputs` may hold on to
/// its parts.
GraphExample GroupNormExample(std::vector<std::string> outputs = {"y"}, std::vector<float> ones = {1, 1}) {
  GraphExample example({-1, 4, 3, 3}, std::move(outputs));
  example.Integers("g", {0, 2, -1}).Weight("ones", {2}, std::move(ones)).Weight("zeros", {2}, {0, 0});
  example.Weight("scale", {4, 1, 1}, {1, 2, 3, 4}).Weight("shift", {4, 1, 1}, {4, 3, 2, 1});
  example.Node("Reshape", {"x", "g"}, "r").Node("InstanceNormalization", {"r", "ones", "zeros"}, "n");
  example.Node("Shape", {"x"}, "s").Node("Reshape", {"n", "s"}, "b").Node("Mul", {"b", "scale"}, "m");
  return example.Node("Add", {"m", "shift"}, "y");
}

TEST(Fused, ANormOfGroupsIsOneNode) {
  const Graph fused = Fused(GroupNormExample().graph);
  EXPECT_NO_THROW(CheckGraph(fused));
  ASSERT_EQ(std::ranges::count(fused.nodes, "GroupNormalization", &GraphNode::op), 1);
  EXPECT_EQ(std::ranges::count(fused.nodes, "InstanceNormalization", &GraphNode::op), 0);
  // What is read elsewhere, or scaled twice, stays as it is written, and has the same numbers.
  const Graph parts = Fused(GroupNormExample({"y", "m"}).graph), scaled = Fused(GroupNormExample({"y"}, {1, 2}).graph);
  EXPECT_EQ(std::ranges::count(parts.nodes, "GroupNormalization", &GraphNode::op), 0);
  EXPECT_EQ(std::ranges::count(scaled.nodes, "GroupNormalization", &GraphNode::op), 0);
  const FloatArray x = FixedArray({2, 4, 3, 3});
  ExpectNear(GroupNormExample().Run(x), GroupNormExample({"y", "m"}).Run(x), 1e-6);
}

}  // namespace
}  // namespace daumier::runtime
