#include "export/lowering.h"

#include "export/parity.h"
#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

#include <torch/nn/modules/linear.h>
#include <torch/utils.h>
#include <set>

namespace daumier::exporting {
namespace {

using tensor::NamedTensors;
using testing::ExpectError;

/// A function that uses an operator, and the ONNX operator that it has to become.
struct Example {
  NamedTensors weights;
  std::vector<int64_t> shape;
  std::function<torch::Tensor(const torch::Tensor& x, const NamedTensors& w)> forward;
  std::string onnx_op;
};

/// One for every operator that can be exported.
std::map<std::string, Example> Examples() {
  torch::manual_seed(2);
  const auto normalise = [](const torch::Tensor& x, const NamedTensors& w) {
    return torch::batch_norm(x, w.at("scale"), w.at("shift"), w.at("mean"), w.at("variance"), false, 0.1, 1e-3, false);
  };
  const NamedTensors of_normalise = {{"scale", torch::rand({2}) + 0.5},
                                     {"shift", torch::randn({2})},
                                     {"mean", torch::randn({2})},
                                     {"variance", torch::rand({2}) + 0.5}};
  const auto convolve = [](const torch::Tensor& x, const NamedTensors& w) {
    return torch::conv2d(x, w.at("w"), w.at("b"), /*stride=*/2, /*padding=*/1);
  };
  const auto affine = [](const torch::Tensor& x, const NamedTensors& w) {
    return torch::addmm(w.at("b"), x, w.at("w").t(), 0.5, 2.0);
  };
  return {
      {"aten::_convolution",
       {{{"w", torch::randn({4, 2, 3, 3})}, {"b", torch::randn({4})}}, {2, 9, 9}, convolve, "Conv"}},
      {"aten::add", {{{"w", torch::randn({4})}}, {4}, [](auto& x, auto& w) { return x + w.at("w"); }, "Add"}},
      {"aten::addmm", {{{"w", torch::randn({5, 3})}, {"b", torch::randn({5})}}, {3}, affine, "Gemm"}},
      {"aten::amax", {{}, {4, 6}, [](auto& x, auto&) { return x.amax(2); }, "ReduceMax"}},
      {"aten::batch_norm", {of_normalise, {2, 3, 3}, normalise, "BatchNormalization"}},
      {"aten::cat",
       {{},
        {4},
        [](auto& x, auto&) {
          return torch::cat({x, x}, 1);
        },
        "Concat"}},
      {"aten::div", {{{"w", torch::rand({4}) + 0.5}}, {4}, [](auto& x, auto& w) { return x / w.at("w"); }, "Div"}},
      {"aten::flatten", {{}, {2, 3}, [](auto& x, auto&) { return x.flatten(1); }, "Flatten"}},
      {"aten::leaky_relu", {{}, {4}, [](auto& x, auto&) { return torch::leaky_relu(x, 0.1); }, "LeakyRelu"}},
      {"aten::matmul",
       {{{"w", torch::randn({2, 3, 5})}},
        {2, 4, 3},
        [](auto& x, auto& w) { return torch::matmul(x, w.at("w")); },
        "MatMul"}},
      {"aten::max_pool2d", {{}, {2, 7, 7}, [](auto& x, auto&) { return torch::max_pool2d(x, 3, 2); }, "MaxPool"}},
      {"aten::mm", {{{"w", torch::randn({3, 5})}}, {3}, [](auto& x, auto& w) { return x.mm(w.at("w")); }, "MatMul"}},
      {"aten::mul", {{{"w", torch::randn({4})}}, {4}, [](auto& x, auto& w) { return x * w.at("w"); }, "Mul"}},
      {"aten::narrow", {{}, {6}, [](auto& x, auto&) { return x.narrow(1, 2, 3); }, "Slice"}},
      {"aten::relu", {{}, {4}, [](auto& x, auto&) { return x.relu(); }, "Relu"}},
      {"aten::reshape",
       {{},
        {6},
        [](auto& x, auto&) {
          return x.reshape({-1, 2, 3});
        },
        "Reshape"}},
      {"aten::sin", {{}, {4}, [](auto& x, auto&) { return torch::sin(x * 30.0); }, "Sin"}},
      {"aten::slice", {{}, {6}, [](auto& x, auto&) { return x.slice(1, 1, 4); }, "Slice"}},
      {"aten::squeeze", {{}, {1, 4}, [](auto& x, auto&) { return x.squeeze(1); }, "Squeeze"}},
      {"aten::sub", {{{"w", torch::randn({4})}}, {4}, [](auto& x, auto& w) { return x - w.at("w"); }, "Sub"}},
      {"aten::t",
       {{{"w", torch::randn({5, 3})}}, {3}, [](auto& x, auto& w) { return x.mm(w.at("w").t()); }, "Transpose"}},
      {"aten::transpose", {{}, {3, 4}, [](auto& x, auto&) { return x.transpose(1, 2); }, "Transpose"}},
      {"aten::unsqueeze", {{}, {4}, [](auto& x, auto&) { return x.unsqueeze(-1); }, "Unsqueeze"}},
  };
}

ExportedFunction FunctionOf(const Example& example) {
  return TestFunction(example.shape, [example](const torch::Tensor& x) { return example.forward(x, example.weights); });
}

std::set<std::string> OperatorsOf(const onnx::ModelProto& model) {
  std::set<std::string> operators;
  for (const auto& node : model.graph().node()) operators.insert(node.op_type());
  return operators;
}

onnx::ModelProto Export(const NamedTensors& weights, const ExportedFunction& function) {
  return ExportToOnnx(Weights(weights), function);
}

TEST(Lowering, EveryOperatorOfTheTableIsExportedByItsExample) {
  const auto examples = Examples();
  for (const auto& [name, lowering] : LoweringTable()) {
    ASSERT_TRUE(examples.count(name) == 1) << name << " has no example";
    const Example& example = examples.at(name);
    EXPECT_EQ(OperatorsOf(Export(example.weights, FunctionOf(example))).count(example.onnx_op), 1u) << name;
  }
  EXPECT_EQ(examples.size(), LoweringTable().size());
}

TEST(Lowering, EveryOperatorGivesTheOutputOfLibTorchInOnnxRuntime) {
  const testing::TempDir folder;
  for (const auto& [name, example] : Examples()) {
    const auto function = FunctionOf(example);
    WriteFileAtomically(folder / "model.onnx", Export(example.weights, function).SerializeAsString());
    const auto report = CheckParity(folder / "model.onnx", function, 1, folder.path());
    if (!report.runtime.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
    EXPECT_LT(report.max_abs_diff(), 1e-5) << name;
  }
}

TEST(Lowering, ConvolutionGivesOneStrideAndTwoPadsADimension) {
  const auto example = Examples().at("aten::_convolution");
  const auto model = Export(example.weights, FunctionOf(example));
  for (const auto& attribute : model.graph().node(0).attribute()) {
    if (attribute.name() == "strides") {
      EXPECT_EQ(attribute.ints_size(), 2);
    }
    if (attribute.name() == "pads") {
      EXPECT_EQ(attribute.ints_size(), 4);
    }
  }
}

TEST(Lowering, LinearLayerBecomesOneGemmOfItsStoredWeight) {
  torch::manual_seed(3);
  torch::nn::Linear layer(3, 5);
  layer->eval();
  const auto model = ExportToOnnx(*layer, TestFunction({3}, [&](const auto& x) { return layer->forward(x); }));
  EXPECT_EQ(OperatorsOf(model), (std::set<std::string>{"Gemm", "Identity"}));
  const auto& gemm = model.graph().node(0);
  EXPECT_EQ(gemm.input(1), "weight");
  EXPECT_EQ(gemm.input(2), "bias");
  for (const auto& attribute : gemm.attribute()) {
    if (attribute.name() == "transB") {
      EXPECT_EQ(attribute.i(), 1);
    }
  }
}

TEST(Lowering, UnknownOperatorIsAnErrorThatNamesItAndItsLine) {
  const auto cumulative = TestFunction({3}, [](const auto& x) { return x.relu().cumsum(1); });
  ExpectError([&] { Export({}, cumulative); }, "operator aten::cumsum cannot be exported to ONNX");
  ExpectError([&] { Export({}, cumulative); }, "= aten::cumsum(%");
}

TEST(Lowering, UsesThatAreNotCoveredAreErrors) {
  const NamedTensors weight = {{"w", torch::randn({4})}};
  ExpectError(
      [&] { Export(weight, TestFunction({4}, [&](const auto& x) { return torch::add(x, weight.at("w"), 2); })); },
      "add with a factor has no lowering");
  ExpectError(
      [&] {
        Export({}, TestFunction({2, 3, 4}, [](const auto& x) { return x.flatten(1, 2); }));
      },
      "only flatten(1, -1)");
}

}  // namespace
}  // namespace daumier::exporting
