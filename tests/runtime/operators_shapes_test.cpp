#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <cmath>
#include <limits>

namespace daumier::runtime {
namespace {

using Ints = std::vector<int64_t>;

FloatArray Counted(Shape shape) {
  FloatArray x(std::move(shape));
  for (size_t i = 0; i < x.values.size(); ++i) x.values[i] = float(i);
  return x;
}

TEST(RuntimeShapes, ViewsKeepTheNumbers) {
  const FloatArray x = Counted({2, 3, 2});
  const auto shape_of = [&](GraphExample example) {
    const FloatArray y = example.Run(x);
    EXPECT_EQ(y.values, x.values);
    return y.shape;
  };
  EXPECT_EQ(shape_of(GraphExample({-1, 3, 2}).Integers("s", {0, -1}).Node("Reshape", {"x", "s"}, "y")), (Shape{2, 6}));
  EXPECT_EQ(shape_of(GraphExample({-1, 3, 2}).Node("Flatten", {"x"}, "y")), (Shape{2, 6}));
  EXPECT_EQ(shape_of(GraphExample({-1, 3, 2}).Integers("a", {1, -1}).Node("Unsqueeze", {"x", "a"}, "y")),
            (Shape{2, 1, 3, 2, 1}));
  EXPECT_EQ(shape_of(GraphExample({-1, 3, 2})
                         .Integers("a", {1})
                         .Node("Unsqueeze", {"x", "a"}, "u")
                         .Node("Squeeze", {"u", "a"}, "y")),
            (Shape{2, 3, 2}));
  EXPECT_EQ(shape_of(GraphExample({-1, 3, 2}).Node("Identity", {"x"}, "y")), (Shape{2, 3, 2}));
}

TEST(RuntimeShapes, RefuseViewsOfAnotherSize) {
  const auto error_of = [](Ints shape, const std::string& part) {
    const GraphExample example = GraphExample({2, 3}).Integers("s", std::move(shape)).Node("Reshape", {"x", "s"}, "y");
    testing::ExpectError([&] { example.Run(Counted({2, 3})); }, part);
  };
  error_of({4, 2}, "(2, 3) cannot be seen as (4, 2)");
  error_of({-1, -1}, "its shape is");
  error_of({-1, 5}, "cannot be seen");
  error_of({0, 0, 0}, "has no size 2");
  error_of({int64_t{1} << 40, int64_t{1} << 40}, "its shape is");
}

TEST(RuntimeShapes, TransposeExchangesAxes) {
  const GraphExample example = GraphExample({2, 3, 2}).Node("Transpose", {"x"}, "y", {{"perm", Ints{1, 2, 0}}});
  const FloatArray y = example.Run(Counted({2, 3, 2}));
  EXPECT_EQ(y.shape, (Shape{3, 2, 2}));
  EXPECT_EQ(y.values, (std::vector<float>{0, 6, 1, 7, 2, 8, 3, 9, 4, 10, 5, 11}));
  const GraphExample twice = GraphExample({2, 3, 2}).Node("Transpose", {"x"}, "y", {{"perm", Ints{1, 1, 0}}});
  testing::ExpectError([&] { twice.Run(Counted({2, 3, 2})); }, "no order of 3 axes");
}

TEST(RuntimeShapes, SliceTakesAPart) {
  const auto slice = [](Ints begin, Ints end, Ints axes, Ints steps) {
    GraphExample example({-1, 4});
    example.Integers("b", std::move(begin)).Integers("e", std::move(end)).Integers("a", std::move(axes));
    example.Integers("s", std::move(steps)).Node("Slice", {"x", "b", "e", "a", "s"}, "y");
    return example.Run(Counted({2, 4})).values;
  };
  EXPECT_EQ(slice({1}, {3}, {1}, {1}), (std::vector<float>{1, 2, 5, 6}));
  EXPECT_EQ(slice({-1}, {100}, {-1}, {1}), (std::vector<float>{3, 7}));
  EXPECT_EQ(slice({0}, {4}, {1}, {3}), (std::vector<float>{0, 3, 4, 7}));
  EXPECT_EQ(slice({1, 1}, {2, 4}, {0, 1}, {1, 2}), (std::vector<float>{5, 7}));
  EXPECT_EQ(slice({3}, {0}, {1}, {-2}), (std::vector<float>{3, 1, 7, 5}));
  EXPECT_EQ(slice({-1}, {std::numeric_limits<int64_t>::min()}, {0}, {-1}),
            (std::vector<float>{4, 5, 6, 7, 0, 1, 2, 3}));
  testing::ExpectError([&] { slice({3}, {3}, {1}, {1}); }, "it takes 3 to 3 by 1 of 4: nothing");
  testing::ExpectError([&] { slice({3}, {0}, {1}, {1}); }, ": nothing");
  testing::ExpectError([&] { slice({3}, {0}, {1}, {0}); }, ": nothing");
  testing::ExpectError([&] { slice({0}, {1}, {2}, {1}); }, "there is no axis 2 of 2");
}

TEST(RuntimeShapes, ConcatJoinsParts) {
  GraphExample example({-1, 2});
  example.graph.inputs.push_back({"z", {-1, 1}});
  example.Node("Concat", {"x", "z", "x"}, "y", {{"axis", int64_t{1}}});
  EXPECT_EQ(example.Run({{2, 2}, {1, 2, 3, 4}}, {{2, 1}, {9, 8}}).values,
            (std::vector<float>{1, 2, 9, 1, 2, 3, 4, 8, 3, 4}));
  testing::ExpectError([&] { example.Run({{2, 2}, {1, 2, 3, 4}}, {{1, 1}, {9}}); }, "a part is (1, 1)");
}

TEST(RuntimeShapes, ConcatOfConvolutionsCopiesNothingAtBatchOne) {
  const FloatArray w = FixedArray({32, 8, 3, 3}, 3);
  GraphExample example({-1, 8, 6, 6});
  const std::map<std::string, GraphAttribute> pads = {{"pads", Ints{1, 1, 1, 1}}};
  example.Weight("w", w.shape, w.values).Weight("v", {16, 32, 1, 1}, FixedNumbers(512, 5));
  example.Node("Conv", {"x", "w"}, "a", pads).Node("Conv", {"a", "v"}, "b");
  example.Node("Concat", {"a", "b"}, "y", {{"axis", int64_t{1}}});
  const auto steps_of = [&](int64_t batch) {
    return GraphRunner(example.graph).StepsFor({{"x", FloatArray({batch, 8, 6, 6})}}).size();
  };
  EXPECT_LT(steps_of(1), steps_of(2));
  // The same numbers as those of the parts, at both batch sizes.
  GraphExample parts = example;
  parts.graph.outputs = {"a", "b"};
  for (const int64_t batch : {1, 2}) {
    const FloatArray x = FixedArray({batch, 8, 6, 6}, 8);
    const FloatArray y = example.Run(x);
    const NamedArrays expected = GraphRunner(parts.graph).Run({{"x", x}});
    for (int64_t n = 0; n < batch; ++n) {
      EXPECT_TRUE(std::equal(expected.at("a").row(n), expected.at("a").row(n) + 32 * 36, y.row(n)));
      EXPECT_TRUE(std::equal(expected.at("b").row(n), expected.at("b").row(n) + 16 * 36, y.row(n) + 32 * 36));
    }
  }
}

TEST(RuntimeShapes, SplitTakesOnePart) {
  const auto part = [](int64_t index, int64_t parts, std::vector<int64_t> sizes) {
    GraphExample example({1, 5});
    std::vector<std::string> inputs = {"x"};
    if (!sizes.empty()) {
      example.Integers("s", std::move(sizes));
      inputs.push_back("s");
    }
    example.Node("Split", inputs, "y", {{"axis", int64_t{1}}, {"part", index}, {"parts", parts}});
    return example.Run(Counted({1, 5})).values;
  };
  EXPECT_EQ(part(0, 2, {}), (std::vector<float>{0, 1, 2}));  // The last part is smaller.
  EXPECT_EQ(part(1, 2, {}), (std::vector<float>{3, 4}));
  EXPECT_EQ(part(1, 3, {1, 3, 1}), (std::vector<float>{1, 2, 3}));
  testing::ExpectError([&] { part(2, 3, {1, 3, 2}); }, "do not fill 5");
  testing::ExpectError([&] { part(0, 2, {1, 3, 1}); }, "it has 2 parts and 3 sizes");
}

TEST(RuntimeShapes, ExpandRepeats) {
  const GraphExample example = GraphExample({2, 1}).Integers("s", {2, 2, 3}).Node("Expand", {"x", "s"}, "y");
  EXPECT_EQ(example.Run({{2, 1}, {1, 2}}).values, (std::vector<float>{1, 1, 1, 2, 2, 2, 1, 1, 1, 2, 2, 2}));
  const GraphExample huge =
      GraphExample({1}).Integers("s", {int64_t{1} << 30, int64_t{1} << 30}).Node("Expand", {"x", "s"}, "y");
  testing::ExpectError([&] { huge.Run({{1}, {1}}); }, "at most");
}

TEST(RuntimeReductions, TakeMeansAndExtremes) {
  const FloatArray x = Counted({2, 2, 3});
  const auto reduce = [&](const std::string& op, Ints axes, int64_t keeps) {
    return GraphExample({2, 2, 3}).Node(op, {"x"}, "y", {{"axes", std::move(axes)}, {"keepdims", keeps}}).Run(x);
  };
  EXPECT_EQ(reduce("ReduceMean", {2}, 0).values, (std::vector<float>{1, 4, 7, 10}));
  EXPECT_EQ(reduce("ReduceMean", {0, 2}, 1).shape, (Shape{1, 2, 1}));
  EXPECT_EQ(reduce("ReduceMean", {0, 2}, 1).values, (std::vector<float>{4, 7}));
  EXPECT_EQ(reduce("ReduceMax", {1}, 0).values, (std::vector<float>{3, 4, 5, 9, 10, 11}));
  EXPECT_EQ(reduce("ReduceMin", {-2}, 0).values, (std::vector<float>{0, 1, 2, 6, 7, 8}));
}

TEST(RuntimeReductions, SumAndTakeAxesAsAnInput) {
  const FloatArray x = Counted({2, 3});
  EXPECT_EQ(GraphExample({2, 3}).Integers("a", {1}).Node("ReduceSum", {"x", "a"}, "y").Run(x).values,
            (std::vector<float>{3, 12}));
  EXPECT_EQ(GraphExample({2, 3}).Integers("a", {0}).Node("ReduceMean", {"x", "a"}, "y").Run(x).values,
            (std::vector<float>{1.5f, 2.5f, 3.5f}));
  EXPECT_EQ(GraphExample({2, 3}).Node("ReduceSum", {"x"}, "y", {{"noop_with_empty_axes", int64_t{1}}}).Run(x).values,
            x.values);
}

TEST(RuntimeReductions, OfImagesInBlocksEqualThoseOfPlainOnes) {
  const FloatArray x = FixedArray({2, 12, 5, 5}), w = FixedArray({12, 12, 1, 1}, 3);
  for (const char* op : {"ReduceMean", "ReduceMax", "ReduceMin"}) {
    GraphExample example({-1, 12, 5, 5}, {"c", "y"});
    example.Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "c");
    example.Node(op, {"c"}, "y", {{"axes", Ints{2, 3}}, {"keepdims", int64_t{0}}});
    const NamedArrays outputs = GraphRunner(example.graph).Run({{"x", x}});
    const FloatArray expected = GraphExample({-1, 12, 5, 5})
                                    .Node(op, {"x"}, "y", {{"axes", Ints{2, 3}}, {"keepdims", int64_t{0}}})
                                    .Run(outputs.at("c"));
    ExpectNear(outputs.at("y"), expected, 1e-6);
  }
}

TEST(RuntimeSoftmax, SumsToOneAlongItsAxis) {
  const FloatArray x({1, 2, 2}, {0, 100, std::log(3.0f), 100});
  const FloatArray y = GraphExample({1, 2, 2}).Node("Softmax", {"x"}, "y", {{"axis", int64_t{1}}}).Run(x);
  ExpectNear(y, {{1, 2, 2}, {0.25f, 0.5f, 0.75f, 0.5f}}, 1e-6);
  const FloatArray log = GraphExample({1, 2, 2}).Node("LogSoftmax", {"x"}, "y", {{"axis", int64_t{1}}}).Run(x);
  ExpectNear(log, {{1, 2, 2}, {std::log(0.25f), std::log(0.5f), std::log(0.75f), std::log(0.5f)}}, 1e-6);
}

TEST(RuntimeSoftmax, FlattensAxesBeforeSet13) {
  const FloatArray x({1, 2, 2}, {0, std::log(2.0f), std::log(3.0f), std::log(4.0f)});
  const FloatArray y =
      GraphExample({1, 2, 2}).Node("Softmax", {"x"}, "y", {{"axis", int64_t{1}}, {"flattens", int64_t{1}}}).Run(x);
  ExpectNear(y, {{1, 2, 2}, {0.1f, 0.2f, 0.3f, 0.4f}}, 1e-6);
}

}  // namespace
}  // namespace daumier::runtime
