#include "tests/export/lowering_example.h"
#include "tests/support/expect_error.h"

#include <torch/nn/functional.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

namespace daumier::exporting {
namespace {

tensor::NamedTensors WeightAndBias(std::vector<int64_t> shape, int64_t num_outputs) {
  return {{"w", torch::randn(shape) * 0.2}, {"b", torch::randn({num_outputs})}};
}

std::vector<Example> LayerExamples() {
  torch::manual_seed(2);
  const tensor::NamedTensors of_norm = {{"scale", torch::rand({5}) + 0.5},
                                        {"shift", torch::randn({5})},
                                        {"mean", torch::randn({5})},
                                        {"variance", torch::rand({5}) + 0.5}};
  const auto norm = [](auto& x, auto& w) {
    return torch::batch_norm(x, w.at("scale"), w.at("shift"), w.at("mean"), w.at("variance"), false, 0.1, 1e-3, false);
  };
  const auto plain_norm = [](auto& x, auto& w) {
    return torch::batch_norm(x, {}, {}, w.at("mean"), w.at("variance"), false, 0.1, 1e-3, false);
  };
  return {
      {"aten::_convolution",
       "Conv",
       {5, 9, 7},
       [](auto& x, auto& w) { return torch::conv2d(x, w.at("w"), w.at("b"), /*stride=*/2, /*padding=*/1); },
       WeightAndBias({4, 5, 3, 3}, 4)},
      {"aten::_convolution",
       "Conv",
       {5, 9, 7},
       [](auto& x, auto& w) { return torch::conv2d(x, w.at("w"), w.at("b"), 1, 2, /*dilation=*/2, /*groups=*/5); },
       WeightAndBias({5, 1, 3, 3}, 5)},
      {"aten::_convolution",
       "Conv",
       {5, 9},
       [](auto& x, auto& w) { return torch::conv1d(x, w.at("w"), w.at("b")); },
       WeightAndBias({4, 5, 1}, 4)},
      {"aten::_convolution",
       "ConvTranspose",
       {5, 4, 6},
       [](auto& x, auto& w) { return torch::conv_transpose2d(x, w.at("w"), w.at("b"), /*stride=*/2, /*padding=*/1); },
       WeightAndBias({5, 3, 4, 4}, 3)},
      {"aten::_convolution",
       "ConvTranspose",
       {5, 4, 6},
       [](auto& x, auto& w) { return torch::conv_transpose2d(x, w.at("w"), w.at("b"), 2, 1, /*output_padding=*/1); },
       WeightAndBias({5, 3, 3, 3}, 3)},
      {"aten::_convolution",
       "ConvTranspose",
       {5, 4, 6},  // OpenCV 4.6 ignores the dilation.
       [](auto& x, auto& w) { return torch::conv_transpose2d(x, w.at("w"), w.at("b"), 1, 1, 0, 1, /*dilation=*/2); },
       WeightAndBias({5, 3, 3, 3}, 3),
       false},
      {"aten::_convolution_mode",
       "Conv",
       {5, 6, 6},
       [](auto& x, auto& w) { return torch::conv2d(x, w.at("w"), w.at("b"), 1, "same"); },
       WeightAndBias({4, 5, 2, 3}, 4)},
      {"aten::_convolution_mode",
       "Conv",
       {5, 6, 6},
       [](auto& x, auto& w) { return torch::conv2d(x, w.at("w"), w.at("b"), 2, "valid"); },
       WeightAndBias({4, 5, 2, 3}, 4)},
      {"aten::addmm",
       "Gemm",
       {3},
       [](auto& x, auto& w) { return torch::addmm(w.at("b"), x, w.at("w").t()); },
       WeightAndBias({5, 3}, 5)},
      {"aten::addmm",
       "MatMul",
       {3},
       [](auto& x, auto& w) { return torch::addmm(w.at("b"), x, w.at("w").t(), /*beta=*/0.5, /*alpha=*/2.0); },
       WeightAndBias({5, 3}, 5)},
      {"aten::addmm",
       "MatMul",
       {3},
       [](auto& x, auto& w) { return torch::addmm(w.at("b"), x, w.at("w")); },
       WeightAndBias({3, 5}, 5)},
      {"aten::batch_norm", "BatchNormalization", {5, 3, 3}, norm, of_norm},
      {"aten::batch_norm", "BatchNormalization", {5}, norm, of_norm},
      {"aten::batch_norm",
       "BatchNormalization",
       {5, 4},
       plain_norm,
       {{"mean", of_norm.at("mean").clone()}, {"variance", of_norm.at("variance").clone()}}},
      {"aten::bmm", "MatMul", {5, 4}, [](auto& x, auto&) { return x.bmm(x.transpose(1, 2)); }},
      {"aten::dropout", "Identity", {5, 4}, [](auto& x, auto&) { return torch::dropout(x, 0.5, /*train=*/false); }},
      {"aten::feature_dropout",
       "Identity",
       {5, 4, 4},
       [](auto& x, auto&) { return torch::feature_dropout(x, 0.5, /*train=*/false); }},
      {"aten::linear",
       "Gemm",
       {3},
       [](auto& x, auto& w) { return torch::linear(x, w.at("w"), w.at("b")); },
       WeightAndBias({5, 3}, 5)},
      {"aten::linear",
       "Gemm",
       {3},
       [](auto& x, auto& w) { return torch::linear(x, w.at("w")); },
       {{"w", torch::randn({5, 3})}}},
      {"aten::linear",
       "MatMul",
       {5, 3},
       [](auto& x, auto& w) { return torch::linear(x, w.at("w"), w.at("b")); },
       WeightAndBias({4, 3}, 4)},
      {"aten::matmul",
       "MatMul",
       {2, 4, 3},
       [](auto& x, auto& w) { return torch::matmul(x, w.at("w")); },
       {{"w", torch::randn({2, 3, 5})}},
       false},
      {"aten::matmul",
       "MatMul",
       {5, 3},
       [](auto& x, auto& w) { return torch::matmul(x, w.at("w")); },
       {{"w", torch::randn({3})}}},
      {"aten::mm", "MatMul", {3}, [](auto& x, auto& w) { return x.mm(w.at("w")); }, {{"w", torch::randn({3, 5})}}},
  };
}

TEST(LayerLowerings, HaveTheOutputsOfLibTorch) {
  ExpectExamples(LayerLowerings(), LayerExamples());
}

TEST(LayerLowerings, ConvolutionGivesItsKernelOneStrideAndTwoPadsADimension) {
  const auto model = ExportExample(LayerExamples().at(0));
  std::map<std::string, int> sizes;
  for (const auto& attribute : model.graph().node(0).attribute()) sizes[attribute.name()] = attribute.ints_size();
  EXPECT_EQ(sizes.at("kernel_shape"), 2);
  EXPECT_EQ(sizes.at("strides"), 2);
  EXPECT_EQ(sizes.at("pads"), 4);
}

TEST(LayerLowerings, LinearLayerBecomesOneGemmOfItsStoredWeight) {
  torch::manual_seed(3);
  torch::nn::Linear layer(3, 5);
  layer->eval();
  const auto model = ExportToOnnx(*layer, TestFunction({3}, [&](const auto& x) { return layer->forward(x); }));
  EXPECT_EQ(OperatorsOf(model), (std::set<std::string>{"Gemm", "Identity"}));
  const auto& gemm = model.graph().node(0);
  EXPECT_EQ(gemm.input(1), "weight");
  EXPECT_EQ(gemm.input(2), "bias");
  ASSERT_EQ(gemm.attribute_size(), 1);
  EXPECT_EQ(gemm.attribute(0).name(), "transB");
  EXPECT_EQ(gemm.attribute(0).i(), 1);
}

TEST(LayerLowerings, LayersInTrainingModeAreErrors) {
  const auto dropout = TestFunction({3}, [](const auto& x) { return torch::dropout(x, 0.5, true); });
  testing::ExpectError([&] { ExportToOnnx(Weights(), dropout); }, "dropout is in training mode");
}

}  // namespace
}  // namespace daumier::exporting
