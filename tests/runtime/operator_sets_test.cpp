#include "runtime/operator_sets.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

namespace daumier::runtime {
namespace {

using Whole = std::vector<int64_t>;

/// What AddNode makes of a node of two outputs at most.
Graph Rewritten(int64_t operator_set, GraphNode node, std::vector<std::string> outputs = {"y"}) {
  Graph graph;
  node.name = "n";
  AddNode({std::move(node), std::move(outputs)}, operator_set, graph);
  return graph;
}
const Whole& IntegersOf(const Graph& graph, size_t input) {
  return graph.weights.at(graph.nodes.at(0).inputs.at(input)).integers;
}
float NumberOf(const Graph& graph, size_t input) {
  return graph.weights.at(graph.nodes.at(0).inputs.at(input)).numbers.at(0);
}

TEST(OperatorSets, AttributesOfEarlierSetsBecomeInputs) {
  const Graph pad =
      Rewritten(9, {.op = "Pad", .inputs = {"x"}, .attributes = {{"pads", Whole{1, 2}}, {"value", 3.0f}}});
  EXPECT_EQ(IntegersOf(pad, 1), (Whole{1, 2}));
  EXPECT_EQ(NumberOf(pad, 2), 3);
  const Graph clip = Rewritten(9, {.op = "Clip", .inputs = {"x"}, .attributes = {{"max", 4.0f}}});
  EXPECT_FALSE(clip.nodes[0].Reads(1));
  EXPECT_EQ(NumberOf(clip, 2), 4);
  const Graph slice = Rewritten(
      9,
      {.op = "Slice", .inputs = {"x"}, .attributes = {{"starts", Whole{1}}, {"ends", Whole{2}}, {"axes", Whole{3}}}});
  EXPECT_EQ(IntegersOf(slice, 1), Whole{1});
  EXPECT_EQ(IntegersOf(slice, 2), Whole{2});
  EXPECT_EQ(IntegersOf(slice, 3), Whole{3});
  for (const char* op : {"Squeeze", "Unsqueeze", "ReduceMean", "ReduceSum"})
    EXPECT_EQ(IntegersOf(Rewritten(11, {.op = op, .inputs = {"x"}, .attributes = {{"axes", Whole{2}}}}), 1), Whole{2});
}

TEST(OperatorSets, ConstantsBecomeWeights) {
  const auto constant = [](const std::string& name, GraphAttribute value) {
    const Graph graph = Rewritten(13, {.op = "Constant", .attributes = {{name, std::move(value)}}});
    EXPECT_TRUE(graph.nodes.empty());
    return graph.weights.at("y");
  };
  EXPECT_EQ(constant("value", GraphTensor{.shape = {1}, .numbers = {5}}).numbers, std::vector<float>{5});
  EXPECT_EQ(constant("value_float", 5.0f).shape, Shape{});
  EXPECT_EQ(constant("value_floats", std::vector<float>{5, 6}).shape, Shape{2});
  EXPECT_EQ(constant("value_int", int64_t{5}).integers, Whole{5});
  EXPECT_EQ(constant("value_ints", Whole{5, 6}).integers, (Whole{5, 6}));
  testing::ExpectError([&] { constant("value_string", std::string("five")); }, "node 'n' (Constant)");
}

TEST(OperatorSets, UpsampleIsResize) {
  for (const char* op : {"Upsample", "Resize"}) {
    const Graph graph = Rewritten(op == std::string("Upsample") ? 9 : 10, {.op = op, .inputs = {"x", "s"}});
    const GraphNode& node = graph.nodes.at(0);
    EXPECT_EQ(node.op, "Resize");
    EXPECT_EQ(node.inputs, (std::vector<std::string>{"x", "", "s"}));
    EXPECT_EQ(node.Text("coordinate_transformation_mode", ""), "asymmetric");
  }
}

TEST(OperatorSets, EmptyInputsOfResizeAreAbsent) {
  Graph graph;
  graph.weights["none"] = {.shape = {0}};
  AddNode({{.op = "Resize", .name = "n", .inputs = {"x", "none", "none", "sizes"}}, {"y"}}, 11, graph);
  EXPECT_EQ(graph.nodes.at(0).inputs, (std::vector<std::string>{"x", "", "", "sizes"}));
}

TEST(OperatorSets, SplitIsANodeForEachOutputThatIsNamed) {
  const Graph graph =
      Rewritten(11, {.op = "Split", .inputs = {"x"}, .attributes = {{"split", Whole{1, 2, 3}}}}, {"a", "", "c"});
  ASSERT_EQ(graph.nodes.size(), 2u);
  EXPECT_EQ(graph.nodes[1].output, "c");
  EXPECT_EQ(graph.nodes[1].Integer("part", -1), 2);
  EXPECT_EQ(graph.nodes[1].Integer("parts", -1), 3);
  EXPECT_EQ(IntegersOf(graph, 1), (Whole{1, 2, 3}));
}

TEST(OperatorSets, SumsOfManyAreSumsOfTwo) {
  GraphExample example({2});
  AddNode({{.op = "Sum", .name = "n", .inputs = {"x", "x", "x"}}, {"three"}}, 13, example.graph);
  AddNode({{.op = "Max", .name = "m", .inputs = {"x", "three"}}, {"larger"}}, 13, example.graph);
  AddNode({{.op = "Sum", .name = "o", .inputs = {"larger"}}, {"y"}}, 13, example.graph);
  EXPECT_EQ(example.graph.nodes.size(), 4u);
  EXPECT_EQ(example.Run({{2}, {1, -2}}).values, (std::vector<float>{3, -2}));
}

TEST(OperatorSets, SoftmaxFlattensAndGroupsAreScaledBeforeTheirSets) {
  EXPECT_EQ(Rewritten(12, {.op = "Softmax", .inputs = {"x"}}).nodes[0].Integer("axis", 0), 1);
  EXPECT_TRUE(Rewritten(12, {.op = "Softmax", .inputs = {"x"}}).nodes[0].Has("flattens"));
  EXPECT_FALSE(Rewritten(13, {.op = "Softmax", .inputs = {"x"}}).nodes[0].Has("flattens"));
  EXPECT_TRUE(Rewritten(18, {.op = "GroupNormalization", .inputs = {"x"}}).nodes[0].Has("scales_groups"));
  EXPECT_FALSE(Rewritten(21, {.op = "GroupNormalization", .inputs = {"x"}}).nodes[0].Has("scales_groups"));
}

TEST(OperatorSets, OutputsOfTrainingAreDropped) {
  const Graph dropout = Rewritten(12, {.op = "Dropout", .inputs = {"x", "ratio"}}, {"y", "mask"});
  EXPECT_EQ(dropout.nodes[0].op, "Identity");
  EXPECT_EQ(dropout.nodes[0].inputs, std::vector<std::string>{"x"});
  EXPECT_EQ(Rewritten(9, {.op = "BatchNormalization", .inputs = {"x"}}, {"y", "m", "v"}).nodes[0].output, "y");
  testing::ExpectError(
      [] {
        Rewritten(14, {.op = "BatchNormalization", .inputs = {"x"}, .attributes = {{"training_mode", int64_t{1}}}});
      },
      "in the form of training");
  testing::ExpectError([] { Rewritten(13, {.op = "TopK", .inputs = {"x"}}, {"y", "i"}); }, "has 2 outputs");
}

TEST(OperatorSets, TooManyNodesAreRefused) {
  Graph graph;
  AddNode({{.op = "Sum", .name = "n", .inputs = std::vector<std::string>(kMostNodes, "x")}, {"y"}}, 13, graph);
  testing::ExpectError(
      [&] {
        AddNode({{.op = "Sum", .name = "n", .inputs = std::vector<std::string>(9, "x")}, {"z"}}, 13, graph);
      },
      "more than 10000 nodes");
}

}  // namespace
}  // namespace daumier::runtime
