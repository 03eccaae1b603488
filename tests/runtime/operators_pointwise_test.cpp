#include "tests/runtime/graph_example.h"
#include "tests/support/expect_error.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace daumier::runtime {
namespace {

TEST(RuntimeFunctions, EqualTheirDefinitions) {
  const std::map<std::string, std::function<double(double)>> functions = {
      {"Abs", [](double x) { return std::abs(x); }},
      {"Ceil", [](double x) { return std::ceil(x); }},
      {"Cos", [](double x) { return std::cos(x); }},
      {"Elu", [](double x) { return x > 0 ? x : std::exp(x) - 1; }},
      {"Erf", [](double x) { return std::erf(x); }},
      {"Exp", [](double x) { return std::exp(x); }},
      {"Floor", [](double x) { return std::floor(x); }},
      {"Gelu", [](double x) { return x / 2 * std::erfc(-x / std::sqrt(2.0)); }},
      {"HardSigmoid", [](double x) { return std::clamp(0.2 * x + 0.5, 0.0, 1.0); }},
      {"HardSwish", [](double x) { return x * std::clamp(x / 6 + 0.5, 0.0, 1.0); }},
      {"LeakyRelu", [](double x) { return x > 0 ? x : 0.01 * x; }},
      {"Mish", [](double x) { return x * std::tanh(std::log1p(std::exp(x))); }},
      {"Neg", [](double x) { return -x; }},
      {"Relu", [](double x) { return std::max(x, 0.0); }},
      {"Round", [](double x) { return std::nearbyint(x); }},
      {"Selu", [](double x) { return 1.0507009873554805 * (x > 0 ? x : 1.6732632423543772 * (std::exp(x) - 1)); }},
      {"Sigmoid", [](double x) { return 1 / (1 + std::exp(-x)); }},
      {"Sin", [](double x) { return std::sin(x); }},
      {"Softplus", [](double x) { return std::log1p(std::exp(x)); }},
      {"Softsign", [](double x) { return x / (1 + std::abs(x)); }},
      {"Tanh", [](double x) { return std::tanh(x); }}};
  FloatArray x = FixedArray({3, 131});
  for (float& number : x.values) number *= 5;
  for (const auto& [name, f] : functions) {
    SCOPED_TRACE(name);
    FloatArray expected = x;
    for (float& number : expected.values) number = float(f(number));
    ExpectNear(GraphExample({-1, 131}).Node(name, {"x"}, "y").Run(x), expected, 1e-6);
  }
  const GraphExample by_tanh = GraphExample({1}).Node("Gelu", {"x"}, "y", {{"approximate", std::string("tanh")}});
  EXPECT_NEAR(by_tanh.Run({{1}, {1}}).values[0], 0.841192, 1e-5);  // 1/2 (1 + tanh(sqrt(2 / pi) 1.044715))
  EXPECT_EQ(GraphExample({2}).Node("Cast", {"x"}, "y", {{"to", int64_t{6}}}).Run({{2}, {1.7f, -1.7f}}).values,
            (std::vector<float>{1, -1}));
  EXPECT_EQ(GraphExample({2}).Node("Cast", {"x"}, "y", {{"to", int64_t{10}}}).Run({{2}, {1.7f, -1.7f}}).values,
            (std::vector<float>{1.7f, -1.7f}));
  GraphExample clip({4});
  clip.Weight("low", {}, {-1}).Weight("high", {}, {2}).Node("Clip", {"x", "low", "high"}, "y");
  EXPECT_EQ(clip.Run({{4}, {-3, 0, 1, 5}}).values, (std::vector<float>{-1, 0, 1, 2}));
  EXPECT_EQ(GraphExample({2}).Node("Sqrt", {"x"}, "y").Run({{2}, {4, 9}}).values, (std::vector<float>{2, 3}));
}

TEST(RuntimeFunctions, BehindAConvolutionArePartOfIt) {
  for (const char* name : {"Relu", "LeakyRelu", "Sigmoid", "Tanh"}) {
    const FloatArray x = FixedArray({2, 3, 6, 6}), w = FixedArray({16, 3, 3, 3}, 7);
    GraphExample fused({-1, 3, 6, 6}), apart({-1, 3, 6, 6}, {"c", "y"});
    for (GraphExample* example : {&fused, &apart})
      example->Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "c").Node(name, {"c"}, "y");
    EXPECT_EQ(GraphRunner(fused.graph).StepsFor({{"x", x}}).size(), 2u);  // It, and the layout of its output.
    EXPECT_GT(GraphRunner(apart.graph).StepsFor({{"x", x}}).size(), 2u);
    ExpectNear(fused.Run(x), apart.Run(x), 1e-6);
  }
}

TEST(RuntimeArithmetic, RepeatsAxesOfSizeOne) {
  const FloatArray column({2, 1}, {1, 2}), row({1, 3}, {10, 20, 30});
  const auto run = [&](const std::string& op, const FloatArray& a, const FloatArray& b) {
    GraphExample example(a.shape);
    example.graph.inputs.push_back({"z", b.shape});
    return example.Node(op, {"x", "z"}, "y").Run(a, b).values;
  };
  EXPECT_EQ(run("Add", column, row), (std::vector<float>{11, 21, 31, 12, 22, 32}));
  EXPECT_EQ(run("Sub", row, column), (std::vector<float>{9, 19, 29, 8, 18, 28}));
  EXPECT_EQ(run("Mul", column, row), (std::vector<float>{10, 20, 30, 20, 40, 60}));
  EXPECT_EQ(run("Div", row, column), (std::vector<float>{10, 20, 30, 5, 10, 15}));
  EXPECT_EQ(run("Max", {{2}, {1, 5}}, {{2}, {3, 4}}), (std::vector<float>{3, 5}));
  EXPECT_EQ(run("Min", {{2}, {1, 5}}, {{2}, {3, 4}}), (std::vector<float>{1, 4}));
  EXPECT_EQ(run("Pow", {{2}, {2, 3}}, {{1}, {3}}), (std::vector<float>{8, 27}));
  EXPECT_EQ(run("PRelu", {{2, 2}, {-1, 2, -3, 4}}, {{2}, {0.5f, 0.25f}}), (std::vector<float>{-0.5f, 2, -1.5f, 4}));
  testing::ExpectError([&] { run("Add", {{2}, {1, 2}}, {{3}, {1, 2, 3}}); }, "the shapes (2) and (3) do not match");
}

TEST(RuntimeArithmetic, OfImagesInBlocksEqualsThatOfPlainOnes) {
  const FloatArray x = FixedArray({2, 12, 5, 5}), w = FixedArray({12, 12, 1, 1}, 3);
  for (const char* op : {"Add", "Sub", "Mul", "Max", "Min", "Div"}) {
    SCOPED_TRACE(op);
    GraphExample example({-1, 12, 5, 5}, {"a", "b", "y"});
    example.Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "a").Node("Conv", {"a", "w"}, "b");
    example.Node(op, {"a", "b"}, "y");
    const NamedArrays outputs = GraphRunner(example.graph).Run({{"x", x}});
    GraphExample plain({-1, 12, 5, 5});
    plain.graph.inputs.push_back({"z", {-1, 12, 5, 5}});
    plain.Node(op, {"x", "z"}, "y");
    EXPECT_EQ(outputs.at("y").values, plain.Run(outputs.at("a"), outputs.at("b")).values);
  }
}

TEST(RuntimeArithmetic, OfAConvolutionAndARepeatedTensorRepeatsEither) {
  const FloatArray x = FixedArray({1, 4, 4, 4}), w = FixedArray({8, 4, 4, 4}, 3);
  GraphExample example({1, 4, 4, 4});  // (1, 8, 1, 1) plus (1, 8, 2, 2), and ReLU
  example.graph.inputs.push_back({"z", {1, 8, 2, 2}});
  example.Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "c").Node("Add", {"c", "z"}, "s");
  example.Node("Relu", {"s"}, "y");
  const FloatArray z = FixedArray({1, 8, 2, 2}, 9);
  const FloatArray c = GraphExample({1, 4, 4, 4}).Weight("w", w.shape, w.values).Node("Conv", {"x", "w"}, "y").Run(x);
  FloatArray expected = z;
  for (size_t i = 0; i < z.values.size(); ++i) expected.values[i] = std::max(0.0f, z.values[i] + c.values[i / 4]);
  ExpectNear(example.Run(x, z), expected, 1e-6);
}

}  // namespace
}  // namespace daumier::runtime
