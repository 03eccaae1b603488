#pragma once
#include "export/lowering.h"
#include "export/parity.h"
#include "runtime/graph_runner.h"
#include "runtime/onnx_file.h"
#include "tensor/array.h"
#include "tests/export/test_function.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace daumier::exporting {

/// A function that uses an operator, and the ONNX operator that it has to become. Where it has channels there are five,
/// for CheckParity takes batches of five too.
struct Example {
  std::string op, onnx_op;
  std::vector<int64_t> shape;  ///< Of one sample.
  std::function<torch::Tensor(const torch::Tensor& x, const tensor::NamedTensors& w)> forward;
  tensor::NamedTensors weights = {};
  bool runs_in_opencv = true;
};

inline std::set<std::string> OperatorsOf(const onnx::ModelProto& model) {
  std::set<std::string> operators;
  for (const auto& node : model.graph().node()) operators.insert(node.op_type());
  return operators;
}

inline ExportedFunction FunctionOf(const Example& example) {
  return TestFunction(example.shape, [example](const torch::Tensor& x) { return example.forward(x, example.weights); });
}

inline onnx::ModelProto ExportExample(const Example& example) {
  return ExportToOnnx(Weights(example.weights), FunctionOf(example));
}

/// The outputs of the model in our own runtime differ from LibTorch's by at most 1e-5 of their largest, at batch 1, 2
/// and 7.
inline void ExpectOwnRuntime(const std::filesystem::path& model, const ExportedFunction& function) {
  const torch::NoGradGuard no_gradients;
  const runtime::GraphRunner runner(runtime::ReadOnnx(model));
  Rng rng = Stream(3, "own runtime");
  for (const int64_t batch : {1, 2, 7}) {
    const torch::Tensor x = function.inputs[0].sample(batch, rng);
    const FloatArray found = runner.Run({{"x", tensor::CopyToArray<float>(x)}}).at("y");
    const FloatArray expected = tensor::CopyToArray<float>(function.forward({x})[0]);
    ASSERT_EQ(found.shape, expected.shape) << "batch " << batch;
    double largest = 0, difference = 0;
    for (size_t i = 0; i < found.values.size(); ++i) {
      largest = std::max(largest, std::abs(double(expected.values[i])));
      difference = std::max(difference, std::abs(double(found.values[i]) - expected.values[i]));
    }
    EXPECT_LE(difference, 1e-5 * largest) << "batch " << batch;
  }
}

/// Every operator of the table has an example, each becomes what it has to, and its outputs are those of LibTorch in
/// our own runtime, in ONNX Runtime (if there is one) and in OpenCV, at several batch sizes.
inline void ExpectExamples(const Lowerings& table, const std::vector<Example>& examples) {
  const testing::TempDir folder;
  std::set<std::string> covered;
  tensor::NamedTensors all_weights;
  // One function of all examples, for a run of ONNX Runtime is a process.
  ExportedFunction all{.name = "examples", .inputs = {}, .output_names = {}, .forward = {}};
  for (size_t i = 0; i < examples.size(); ++i) {
    const Example& example = examples[i];
    SCOPED_TRACE(fmt::format("example {} of {}", i, example.op));
    covered.insert(example.op);
    const onnx::ModelProto model = ExportExample(example);
    EXPECT_EQ(OperatorsOf(model).count(example.onnx_op), 1u);
    WriteFileAtomically(folder / "model.onnx", model.SerializeAsString());
    ExpectOwnRuntime(folder / "model.onnx", FunctionOf(example));
    const OtherRuntime opencv = CompareWithOpenCv(folder / "model.onnx", FunctionOf(example), 1);
    EXPECT_EQ(opencv.agrees(), example.runs_in_opencv)
        << opencv.refusal.value_or("") << " " << opencv.max_relative_diff.value_or(-1);
    for (const auto& [name, weight] : example.weights) all_weights[fmt::format("{}_{}", name, i)] = weight;
    all.inputs.push_back(FunctionOf(example).inputs[0]);
    all.inputs.back().name = fmt::format("x{}", i);
    all.output_names.push_back(fmt::format("y{}", i));
  }
  for (const auto& [op, lowering] : table) EXPECT_EQ(covered.count(op), 1u) << op << " has no example";
  all.forward = [&](const std::vector<torch::Tensor>& inputs) {
    std::vector<torch::Tensor> outputs;
    for (size_t i = 0; i < inputs.size(); ++i) outputs.push_back(examples[i].forward(inputs[i], examples[i].weights));
    return outputs;
  };
  WriteFileAtomically(folder / "all.onnx", ExportToOnnx(Weights(all_weights), all).SerializeAsString());
  const ParityReport report = CheckParity(folder / "all.onnx", all, 1, folder.path());
  for (size_t i = 0; i < report.max_abs_diffs.size(); ++i)
    EXPECT_LT(report.max_abs_diffs[i], 1e-5) << "example " << i << " of " << examples[i].op;
}

}  // namespace daumier::exporting
