#include "export/onnx_export.h"

#include "tests/export/test_function.h"
#include "tests/support/expect_error.h"

#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>
#include <cstring>

namespace daumier::exporting {
namespace {

using testing::ExpectError;

struct SmallNetwork : torch::nn::Module {
  SmallNetwork() {
    torch::manual_seed(4);
    convolution = register_module("convolution", torch::nn::Conv2d(1, 2, 3));
    norm = register_module("norm", torch::nn::BatchNorm2d(2));
    linear = register_module("linear", torch::nn::Linear(18, 3));
    unused = register_buffer("unused", torch::ones({4}));
    forward(torch::randn({6, 1, 5, 5}));
    eval();
  }
  torch::Tensor forward(const torch::Tensor& x) { return linear(norm(convolution(x)).relu().flatten(1)); }

  torch::nn::Conv2d convolution{nullptr};
  torch::nn::BatchNorm2d norm{nullptr};
  torch::nn::Linear linear{nullptr};
  torch::Tensor unused;
};

ExportedFunction SmallFunction(SmallNetwork& network) {
  return TestFunction({1, 5, 5}, [&](const torch::Tensor& x) { return network.forward(x); });
}

TEST(OnnxExport, InitializersAreTheUsedWeightsValueByValue) {
  SmallNetwork network;
  const auto model = ExportToOnnx(network, SmallFunction(network));
  const auto state = tensor::StateOf(network);
  std::vector<std::string> names;
  for (const auto& stored : model.graph().initializer()) {
    names.push_back(stored.name());
    const auto& weight = state.at(stored.name());
    ASSERT_EQ(stored.raw_data().size(), weight.nbytes());
    EXPECT_EQ(std::memcmp(stored.raw_data().data(), weight.contiguous().data_ptr(), weight.nbytes()), 0)
        << stored.name();
  }
  // In the order of use, without `unused` and `norm.num_batches_tracked`.
  EXPECT_EQ(names, (std::vector<std::string>{"convolution.weight", "convolution.bias", "norm.weight", "norm.bias",
                                             "norm.running_mean", "norm.running_var", "linear.weight", "linear.bias"}));
}

TEST(OnnxExport, GraphFollowsTheNetwork) {
  SmallNetwork network;
  const auto model = ExportToOnnx(network, SmallFunction(network));
  std::vector<std::string> operators;
  for (const auto& node : model.graph().node()) operators.push_back(node.op_type());
  EXPECT_EQ(operators, (std::vector<std::string>{"Conv", "BatchNormalization", "Relu", "Flatten", "Gemm", "Identity"}));
}

TEST(OnnxExport, ExportTwiceGivesEqualBytes) {
  SmallNetwork network;
  EXPECT_EQ(ExportToOnnx(network, SmallFunction(network)).SerializeAsString(),
            ExportToOnnx(network, SmallFunction(network)).SerializeAsString());
}

TEST(OnnxExport, BatchSizeThatIsBakedInIsAnError) {
  const auto baked = TestFunction({6}, [](const torch::Tensor& x) { return x.reshape({x.size(0) * 2, 3}); });
  ExpectError([&] { ExportToOnnx(Weights(), baked); }, "has the batch size baked in");
}

TEST(OnnxExport, TrainingModeAndUnnamedOutputsAreErrors) {
  SmallNetwork network;
  auto function = SmallFunction(network);
  function.output_names = {"y", "z"};
  ExpectError([&] { ExportToOnnx(network, function); }, "1 outputs, but 2 have names");
  network.train();
  ExpectError([&] { ExportToOnnx(network, SmallFunction(network)); }, "call eval()");
}

TEST(OnnxExport, StrictInferenceFindsWhatTheCheckerLetsPass) {
  SmallNetwork network;
  auto model = ExportToOnnx(network, SmallFunction(network));
  EXPECT_NO_THROW(CheckOnnx(model));
  auto wrong_strides = model;
  for (auto& attribute : *wrong_strides.mutable_graph()->mutable_node(0)->mutable_attribute()) {
    if (attribute.name() == "strides") attribute.mutable_ints()->RemoveLast();
  }
  ExpectError([&] { CheckOnnx(wrong_strides); }, "ONNX refuses the graph 'test'");
  auto unknown_operator = model;
  unknown_operator.mutable_graph()->mutable_node(0)->set_op_type("Convolute");
  ExpectError([&] { CheckOnnx(unknown_operator); }, "Convolute");
}

}  // namespace
}  // namespace daumier::exporting
