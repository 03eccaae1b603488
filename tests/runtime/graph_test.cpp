#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <limits>

namespace daumier::runtime {
namespace {

TEST(CheckGraph, RefusesNamesThatAreNotComputed) {
  Graph graph = GraphExample({2}).Node("Relu", {"x"}, "y").graph;
  EXPECT_NO_THROW(CheckGraph(graph));
  Graph cycle = GraphExample({2}).Node("Add", {"x", "b"}, "a").Node("Relu", {"a"}, "b").Node("Relu", {"b"}, "y").graph;
  testing::ExpectError([&] { CheckGraph(cycle); }, "node 'Add_a' (Add) reads 'b', which no earlier node computes");
  graph.outputs = {"z"};
  testing::ExpectError([&] { CheckGraph(graph); }, "no node computes the output 'z'");
  graph.outputs = {};
  testing::ExpectError([&] { CheckGraph(graph); }, "1 inputs and 0 outputs");
}

TEST(CheckGraph, RefusesWeightsThatDoNotFillTheirShape) {
  Graph graph = GraphExample({2}).Weight("w", {3}, {1, 2}).Node("Mul", {"x", "w"}, "y").graph;
  testing::ExpectError([&] { CheckGraph(graph); }, "the tensor 'w' has 2 numbers, expected 3 for the shape (3)");
  graph.weights["w"] = {.shape = {1}, .numbers = {std::numeric_limits<float>::quiet_NaN()}};
  testing::ExpectError([&] { CheckGraph(graph); }, "not finite");
  graph.weights["w"] = {.shape = {1}, .numbers = {1}};
  EXPECT_NO_THROW(CheckGraph(graph));
}

TEST(CheckGraph, RefusesTooManyNodes) {
  GraphExample example({2});
  for (size_t i = 0; i <= kMostNodes; ++i)
    example.Node("Relu", {i == 0 ? "x" : "v" + std::to_string(i - 1)}, "v" + std::to_string(i));
  testing::ExpectError([&] { CheckGraph(example.graph); }, "at most 10000 are read");
}

TEST(CheckGraph, RefusesANodeWithoutAnInput) {
  const GraphExample example = GraphExample({1}).Node("Relu", {}, "y");
  testing::ExpectError([&] { CheckGraph(example.graph); }, "node 'Relu_y' (Relu) has no input");
}

TEST(CheckedSize, RefusesWhatIsTooLarge) {
  EXPECT_EQ(CheckedSize({2, 3}, "it"), 6);
  EXPECT_EQ(CheckedSize({}, "it"), 1);
  testing::ExpectError([] { CheckedSize({int64_t{1} << 62, 4}, "it"); }, "it has the shape");
  testing::ExpectError([] { CheckedSize({2, -1}, "it"); }, "it has the shape (2, -1)");
  testing::ExpectError([] { CheckedSize(Shape(9, 1), "it"); }, "it has 9 dimensions");
}

TEST(GraphNode, NamesAnAttributeOfAnotherType) {
  const GraphNode node{"Conv", "first", {}, "y", {{"group", int64_t{2}}}};
  EXPECT_EQ(node.Integer("group", 1), 2);
  EXPECT_EQ(node.Integer("other", 1), 1);
  testing::ExpectError([&] { node.Real("group", 1); }, "node 'first' (Conv): the attribute 'group' is of another type");
}

}  // namespace
}  // namespace daumier::runtime
