#include "runtime/constant_folding.h"

#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <limits>

namespace daumier::runtime {
namespace {

using Folded = std::vector<int64_t>;

GraphTensor WholeTensor(Shape shape, Folded integers) {
  return {.shape = std::move(shape), .integers = std::move(integers), .has_integers = true};
}
GraphTensor WholeRow(Folded integers) {
  return {.shape = {int64_t(integers.size())}, .integers = std::move(integers), .has_integers = true};
}
GraphTensor RealRow(std::vector<float> numbers) {
  return {.shape = {int64_t(numbers.size())}, .numbers = std::move(numbers)};
}

std::optional<GraphTensor> TryFold(const std::string& op, const std::vector<GraphTensor>& inputs,
                                   std::map<std::string, GraphAttribute> attributes = {}) {
  GraphNode node{.op = op, .name = "n", .output = "y", .attributes = std::move(attributes)};
  std::vector<KnownInput> known;
  for (const GraphTensor& input : inputs) {
    node.inputs.push_back("i" + std::to_string(known.size()));
    known.push_back({&input.shape, &input});
  }
  return ConstantFolder().Fold(node, known);
}
GraphTensor Fold(const std::string& op, const std::vector<GraphTensor>& inputs,
                 std::map<std::string, GraphAttribute> attributes = {}) {
  const std::optional<GraphTensor> folded = TryFold(op, inputs, std::move(attributes));
  EXPECT_TRUE(folded.has_value()) << op;
  return folded.value_or(GraphTensor{});
}

TEST(ConstantFolder, ComputesWithWholeNumbers) {
  const GraphTensor a = WholeRow({7, -7}), b = WholeRow({2, 2});
  EXPECT_EQ(Fold("Add", {a, b}).integers, (Folded{9, -5}));
  EXPECT_EQ(Fold("Sub", {a, b}).integers, (Folded{5, -9}));
  EXPECT_EQ(Fold("Mul", {a, b}).integers, (Folded{14, -14}));
  EXPECT_EQ(Fold("Div", {a, b}).integers, (Folded{3, -3}));
  EXPECT_EQ(Fold("Mod", {a, b}).integers, (Folded{1, 1}));
  EXPECT_EQ(Fold("Min", {a, b}).integers, (Folded{2, -7}));
  EXPECT_EQ(Fold("Max", {a, b}).integers, (Folded{7, 2}));
  EXPECT_EQ(Fold("Greater", {a, b}).integers, (Folded{1, 0}));
  EXPECT_EQ(Fold("Equal", {a, WholeTensor({}, {7})}).integers, (Folded{1, 0}));
  EXPECT_EQ(Fold("Neg", {a}).integers, (Folded{-7, 7}));
  EXPECT_EQ(Fold("Not", {WholeRow({0, 1})}).integers, (Folded{1, 0}));
  EXPECT_EQ(Fold("ReduceProd", {WholeRow({2, 3, 4})}).integers, Folded{24});
  EXPECT_EQ(Fold("ReduceSum", {WholeRow({2, 3, 4})}, {{"keepdims", int64_t{0}}}).shape, Shape{});
  EXPECT_EQ(Fold("Range", {WholeTensor({}, {5}), WholeTensor({}, {0}), WholeTensor({}, {-2})}).integers,
            (Folded{5, 3, 1}));
}

TEST(ConstantFolder, ComputesWithRealNumbers) {
  EXPECT_EQ(Fold("Floor", {RealRow({1.5f, -1.5f})}).numbers, (std::vector<float>{1, -2}));
  EXPECT_EQ(Fold("Round", {RealRow({0.5f, 1.5f})}).numbers, (std::vector<float>{0, 2}));
  EXPECT_EQ(Fold("Cast", {RealRow({1.9f, -1.9f})}, {{"to", int64_t{7}}}).integers, (Folded{1, -1}));
  EXPECT_EQ(Fold("Cast", {RealRow({0.5f, 0})}, {{"to", int64_t{9}}}).integers, (Folded{1, 0}));
  EXPECT_EQ(Fold("Cast", {WholeRow({3})}, {{"to", int64_t{1}}}).numbers, std::vector<float>{3});
  EXPECT_EQ(Fold("Mul", {RealRow({1, 2}), RealRow({4})}).numbers, (std::vector<float>{4, 8}));
}

TEST(ConstantFolder, TakesPartsAndJoinsThem) {
  const GraphTensor table = WholeTensor({2, 3}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(Fold("Transpose", {table}).integers, (Folded{1, 4, 2, 5, 3, 6}));
  EXPECT_EQ(Fold("Gather", {table, WholeTensor({}, {-1})}, {{"axis", int64_t{1}}}).integers, (Folded{3, 6}));
  EXPECT_EQ(Fold("Gather", {table, WholeRow({1})}).shape, (Shape{1, 3}));
  EXPECT_EQ(Fold("Slice", {table, WholeRow({-1}), WholeRow({std::numeric_limits<int64_t>::min()}), WholeRow({0}),
                           WholeRow({-1})})
                .integers,
            (Folded{4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(Fold("Concat", {table, WholeTensor({2, 1}, {8, 9})}, {{"axis", int64_t{1}}}).integers,
            (Folded{1, 2, 3, 8, 4, 5, 6, 9}));
  EXPECT_EQ(Fold("Concat", {WholeRow({}), WholeRow({4})}, {{"axis", int64_t{0}}}).integers, Folded{4});
  EXPECT_EQ(Fold("Expand", {WholeRow({3}), WholeRow({2, 2})}).integers, (Folded{3, 3, 3, 3}));
  EXPECT_EQ(Fold("ConstantOfShape", {WholeRow({2})}).numbers, (std::vector<float>{0, 0}));
  EXPECT_EQ(Fold("ConstantOfShape", {WholeRow({2})}, {{"value", WholeRow({5})}}).integers, (Folded{5, 5}));
  EXPECT_EQ(Fold("Where", {WholeRow({1, 0}), WholeRow({3, 4}), WholeTensor({}, {9})}).integers, (Folded{3, 9}));
}

TEST(ConstantFolder, ShapesAreKnownWithoutNumbers) {
  const Shape shape = {2, 3, 4};
  const auto fold = [&](const std::string& op, std::map<std::string, GraphAttribute> attributes) {
    return ConstantFolder().Fold({.op = op, .inputs = {"x"}, .attributes = std::move(attributes)}, {{&shape, nullptr}});
  };
  EXPECT_EQ(fold("Shape", {})->integers, (Folded{2, 3, 4}));
  EXPECT_EQ(fold("Shape", {{"start", int64_t{-2}}, {"end", int64_t{9}}})->integers, (Folded{3, 4}));
  EXPECT_EQ(fold("Size", {})->integers, Folded{24});
  EXPECT_FALSE(fold("Neg", {}).has_value());
}

TEST(ConstantFolder, RefusesWhatOverflowsOrDividesByZero) {
  const int64_t highest = std::numeric_limits<int64_t>::max(), lowest = std::numeric_limits<int64_t>::min();
  const auto refused = [](const std::string& op, const std::vector<GraphTensor>& inputs, const std::string& part,
                          std::map<std::string, GraphAttribute> attributes = {}) {
    testing::ExpectError([&] { TryFold(op, inputs, attributes); }, "node 'n' (" + op + "): ");
    testing::ExpectError([&] { TryFold(op, inputs, attributes); }, part);
  };
  refused("Add", {WholeRow({highest}), WholeRow({1})}, "more than 64 bits");
  refused("Sub", {WholeRow({lowest}), WholeRow({1})}, "more than 64 bits");
  refused("Mul", {WholeRow({highest}), WholeRow({2})}, "more than 64 bits");
  refused("Neg", {WholeRow({lowest})}, "more than 64 bits");
  refused("Div", {WholeRow({1}), WholeRow({0})}, "1 is divided by 0");
  refused("Div", {WholeRow({lowest}), WholeRow({-1})}, "is divided by -1");
  refused("Mod", {WholeRow({lowest}), WholeRow({-1})}, "is divided by -1");
  refused("Cast", {RealRow({1e30f})}, "is cast to a whole number", {{"to", int64_t{7}}});
  refused("Cast", {RealRow({1})}, "the element type 8", {{"to", int64_t{8}}});
  refused("Div", {RealRow({1}), RealRow({0})}, "its numbers are not finite");
  refused("Add", {RealRow({1}), WholeRow({0})}, "of integers and other numbers");
  refused("Gather", {WholeRow({1}), WholeRow({1})}, "there is no index 1 of 1");
  refused("Range", {WholeTensor({}, {0}), WholeTensor({}, {1}), WholeTensor({}, {0})}, "by 0");
  refused("ReduceMax", {WholeRow({})}, "its input is empty");
}

TEST(ConstantFolder, LeavesWhatIsTooLarge) {
  const int64_t many = ConstantFolder::kMostFolded + 1;
  EXPECT_FALSE(TryFold("ConstantOfShape", {WholeRow({many})}).has_value());
  EXPECT_FALSE(TryFold("Expand", {WholeRow({1}), WholeRow({many})}).has_value());
  EXPECT_FALSE(TryFold("Range", {WholeTensor({}, {0}), WholeTensor({}, {many}), WholeTensor({}, {1})}).has_value());
  ConstantFolder folder;  // All nodes together.
  const GraphTensor size = WholeRow({ConstantFolder::kMostFolded / 2 + 1});
  const GraphNode node{.op = "ConstantOfShape", .inputs = {"s"}};
  EXPECT_TRUE(folder.Fold(node, {{&size.shape, &size}}).has_value());
  EXPECT_FALSE(folder.Fold(node, {{&size.shape, &size}}).has_value());
}

TEST(FoldedConstants, NodesOfWeightsAloneBecomeWeights) {
  GraphExample example({1, 2});
  example.Weight("a", {2, 2}, {1, 2, 3, 4}).Node("Transpose", {"a"}, "t");
  example.Node("MatMul", {"x", "t"}, "y");
  const Graph folded = FoldedConstants(example.graph);
  ASSERT_EQ(folded.nodes.size(), 1u);
  EXPECT_EQ(folded.weights.at("t").numbers, (std::vector<float>{1, 3, 2, 4}));
  EXPECT_EQ(example.Run({{1, 2}, {1, 10}}).values, (std::vector<float>{21, 43}));
}

TEST(FoldedConstants, PlansAreMadeForSizesOfTheInput) {
  GraphExample example({1, 1, -1, -1});  // To twice its size by the arithmetic of exporters.
  example.Integers("b", {0}).Integers("m", {2}).Integers("e", {4}).Integers("two", {2, 2});
  example.Node("Shape", {"x"}, "s").Node("Slice", {"s", "m", "e"}, "hw").Node("Slice", {"s", "b", "m"}, "nc");
  example.Node("Mul", {"hw", "two"}, "d").Node("Concat", {"nc", "d"}, "sizes", {{"axis", int64_t{0}}});
  example.Node("Resize", {"x", "", "", "sizes"}, "y", {{"nearest_mode", std::string("floor")}});
  const GraphRunner runner(example.graph);
  for (const int64_t side : {1, 3}) {
    const FloatArray x = FixedArray({1, 1, side, side + 1});
    EXPECT_EQ(runner.Run({{"x", x}}).at("y").shape, (Shape{1, 1, 2 * side, 2 * side + 2}));
  }
}

TEST(FoldedConstants, NumbersFromShapesAreReadLikeOthers) {
  GraphExample example({-1, 2});  // x times the number of its rows.
  example.Integers("i", {0}).Node("Shape", {"x"}, "s").Node("Gather", {"s", "i"}, "n");
  example.Node("Cast", {"n"}, "f", {{"to", int64_t{1}}}).Node("Mul", {"x", "f"}, "y");
  const GraphRunner runner(example.graph);
  EXPECT_EQ(runner.Run({{"x", {{1, 2}, {1, 2}}}}).at("y").values, (std::vector<float>{1, 2}));
  EXPECT_EQ(runner.Run({{"x", {{2, 2}, {1, 2, 3, 4}}}}).at("y").values, (std::vector<float>{2, 4, 6, 8}));
}

}  // namespace
}  // namespace daumier::runtime
