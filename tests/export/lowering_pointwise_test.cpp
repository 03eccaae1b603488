#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

#include <torch/utils.h>

namespace daumier::exporting {
namespace {

const std::vector<int64_t> kImage = {5, 3, 4};

Example OfOne(const std::string& op, const std::string& onnx_op, torch::Tensor (*function)(const torch::Tensor&)) {
  return {op, onnx_op, kImage, [function](auto& x, auto&) { return function(x); }};
}

/// x OP w, or w OP x.
Example OfWeight(const std::string& op, const std::string& onnx_op, std::vector<int64_t> shape,
                 std::vector<int64_t> weight, torch::Tensor (*function)(const torch::Tensor&, const torch::Tensor&)) {
  return {op,
          onnx_op,
          shape,
          [function](auto& x, auto& w) { return function(x, w.at("w")); },
          {{"w", torch::rand(weight) + 0.5}}};
}

std::vector<Example> PointwiseExamples() {
  torch::manual_seed(2);
  using T = const torch::Tensor&;
  const auto add = [](T x, T w) { return x + w; };
  const auto mul = [](T x, T w) { return x * w; };
  const auto sub = [](T x, T w) { return x - w; };
  const auto div = [](T x, T w) { return x / w; };
  std::vector<Example> examples = {
      OfOne("aten::abs", "Abs", [](T x) { return x.abs(); }),
      OfOne("aten::add", "Add", [](T x) { return x + x.relu(); }),
      OfOne("aten::add", "Add", [](T x) { return x + 2; }),
      OfOne("aten::add", "Mul", [](T x) { return torch::add(x, x.relu(), /*alpha=*/2); }),
      OfOne("aten::clamp", "Relu", [](T x) { return x.clamp(-0.2, 0.3); }),
      OfOne("aten::clamp_max", "Relu", [](T x) { return x.clamp_max(0.3); }),
      OfOne("aten::clamp_min", "Relu", [](T x) { return x.clamp_min(0); }),
      OfOne("aten::div", "Div", [](T x) { return x / 3; }),
      OfOne("aten::div", "Div", [](T x) { return x / (x.relu() + 2); }),
      OfOne("aten::elu", "Elu", [](T x) { return torch::elu(x, 0.7); }),
      OfOne("aten::exp", "Exp", [](T x) { return x.exp(); }),
      OfOne("aten::full_like", "Sub", [](T x) { return 1 - x; }),
      OfOne("aten::full_like", "Div", [](T x) { return 1 / (x + 2); }),
      OfOne("aten::hardtanh", "Relu", [](T x) { return torch::hardtanh(x * 3); }),
      OfOne("aten::leaky_relu", "LeakyRelu", [](T x) { return torch::leaky_relu(x, 0.1); }),
      OfOne("aten::max", "Max", [](T x) { return torch::max(x, 2 * x); }),
      OfOne("aten::maximum", "Max", [](T x) { return torch::maximum(x, 2 * x); }),
      OfOne("aten::min", "Min", [](T x) { return torch::min(x, 2 * x); }),
      OfOne("aten::minimum", "Min", [](T x) { return torch::minimum(x, 2 * x); }),
      OfOne("aten::mul", "Mul", [](T x) { return x * x.sigmoid(); }),
      OfOne("aten::neg", "Neg", [](T x) { return -x; }),
      OfOne("aten::pow", "Mul", [](T x) { return x.pow(2); }),
      OfOne("aten::pow", "Sqrt", [](T x) { return (x + 2).pow(0.5); }),
      OfOne("aten::pow", "Pow", [](T x) { return (x + 2).pow(3); }),
      OfOne("aten::relu", "Relu", [](T x) { return x.relu(); }),
      OfOne("aten::relu6", "Relu", [](T x) { return torch::relu6(x * 10); }),
      OfOne("aten::sigmoid", "Sigmoid", [](T x) { return x.sigmoid(); }),
      OfOne("aten::silu", "Sigmoid", [](T x) { return torch::silu(x); }),
      OfOne("aten::sin", "Sin", [](T x) { return torch::sin(x * 30.0); }),
      OfOne("aten::sqrt", "Sqrt", [](T x) { return (x + 2).sqrt(); }),
      OfOne("aten::square", "Mul", [](T x) { return x.square(); }),
      OfOne("aten::sub", "Sub", [](T x) { return x - x.relu(); }),
      OfOne("aten::tanh", "Tanh", [](T x) { return x.tanh(); }),
      OfWeight("aten::prelu", "PRelu", kImage, {5}, [](T x, T w) { return torch::prelu(x, w); }),
      OfWeight("aten::prelu", "PRelu", kImage, {1}, [](T x, T w) { return torch::prelu(x, w); }),
      OfWeight("aten::prelu", "PRelu", {5}, {5}, [](T x, T w) { return torch::prelu(x, w); }),
      // Of which OpenCV 4.6 exchanges the sides.
      OfWeight("aten::sub", "Neg", {4}, {4}, [](T x, T w) { return w - x; }),
      OfWeight("aten::div", "Div", kImage, {5, 1, 1}, [](T x, T w) { return w / (x + 2); }),
      // Columns times rows.
      {"aten::mul", "MatMul", {6, 4}, [](auto& x, auto&) { return x.slice(2, 0, 1) * x.slice(1, 0, 1); }},
      // Bounds that Relu would round.
      {"aten::clamp", "Clip", kImage, [](auto& x, auto&) { return x.clamp(-100, 0.3); }, {}, false},
      {"aten::clamp_max", "Clip", kImage, [](auto& x, auto&) { return (x * 100).clamp_max(20); }, {}, false},
  };
  // Numbers for each channel, each column, each pixel.
  const std::vector<std::pair<std::vector<int64_t>, std::vector<int64_t>>> shapes = {
      {{4}, {4}},          {{5, 4}, {4}}, {{5, 4}, {5, 1}}, {kImage, {5, 1, 1}}, {kImage, {1, 5, 1, 1}},
      {kImage, {1, 1, 1}}, {kImage, {4}}, {kImage, {3, 4}}, {kImage, {3, 1}},    {kImage, {5, 3, 4}}};
  for (const auto& [shape, weight] : shapes) {
    examples.push_back(OfWeight("aten::add", "Add", shape, weight, add));
    examples.push_back(OfWeight("aten::mul", "Mul", shape, weight, mul));
    examples.push_back(OfWeight("aten::sub", "Sub", shape, weight, sub));
    examples.push_back(OfWeight("aten::div", "Div", shape, weight, div));
  }
  return examples;
}

TEST(PointwiseLowerings, HaveTheOutputsOfLibTorch) {
  ExpectExamples(PointwiseLowerings(), PointwiseExamples());
}

TEST(PointwiseLowerings, ABoundedNumberStaysWithinItsBounds) {
  const auto model = ExportToOnnx(Weights(), TestFunction({3}, [](const auto& x) { return torch::relu6(x); }));
  EXPECT_EQ(OperatorsOf(model), (std::set<std::string>{"Relu", "Sub", "Identity"}));
}

TEST(PointwiseLowerings, UsesThatAreNotCoveredAreErrors) {
  const auto expect = [](torch::Tensor (*function)(const torch::Tensor&), const char* message) {
    testing::ExpectError([&] { ExportToOnnx(Weights(), TestFunction({4}, function)); }, message);
  };
  expect([](const torch::Tensor& x) { return torch::selu(x); }, "aten::selu cannot be exported");
  expect([](const torch::Tensor& x) { return torch::elu(x, 1, 2); }, "elu with scales");
  expect([](const torch::Tensor& x) { return torch::div(x, 2, "floor"); }, "a division that rounds");
  expect(
      [](const torch::Tensor& x) {
        return torch::cat({x, torch::full_like(x, 2)}, 1);
      },
      "its constant is read by more than arithmetic");
}

}  // namespace
}  // namespace daumier::exporting
