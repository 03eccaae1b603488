// Small networks of the kinds that are exported: residual ones, a U-Net with heat maps.
#include "export/parity.h"
#include "tests/export/test_function.h"

#include <torch/nn/functional.h>
#include <torch/nn/modules/batchnorm.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>
#include <torch/utils.h>

namespace daumier::exporting {
namespace {

namespace nn = torch::nn;

struct ConvNormImpl : nn::Module {
  ConvNormImpl(int64_t from, int64_t to, int64_t kernel, int64_t stride = 1) {
    const auto options = nn::Conv2dOptions(from, to, kernel).stride(stride).padding(kernel / 2).bias(false);
    conv = register_module("conv", nn::Conv2d(options));
    norm = register_module("norm", nn::BatchNorm2d(to));
    norm->running_mean.uniform_(-0.2, 0.2);
    norm->running_var.uniform_(0.5, 1.5);
  }
  torch::Tensor forward(const torch::Tensor& x) { return norm(conv(x)); }
  nn::Conv2d conv{nullptr};
  nn::BatchNorm2d norm{nullptr};
};
TORCH_MODULE(ConvNorm);

/// Two or (a bottleneck) three convolutions and a shortcut [He et al. 2016].
struct BlockImpl : nn::Module {
  BlockImpl(int64_t from, int64_t to, int64_t stride, bool bottleneck) {
    if (bottleneck) {
      layers = {ConvNorm(from, to / 4, 1), ConvNorm(to / 4, to / 4, 3, stride), ConvNorm(to / 4, to, 1)};
    } else {
      layers = {ConvNorm(from, to, 3, stride), ConvNorm(to, to, 3)};
    }
    for (size_t i = 0; i < layers.size(); ++i) register_module(fmt::format("layer{}", i), layers[i]);
    if (from != to || stride != 1) shortcut = register_module("shortcut", ConvNorm(from, to, 1, stride));
  }
  torch::Tensor forward(const torch::Tensor& x) {
    torch::Tensor y = x;
    for (size_t i = 0; i < layers.size(); ++i) y = i + 1 < layers.size() ? layers[i](y).relu() : layers[i](y);
    y += shortcut.is_empty() ? x : shortcut(x);
    return y.relu_();
  }
  std::vector<ConvNorm> layers;
  ConvNorm shortcut{nullptr};
};
TORCH_MODULE(Block);

/// The stem, the stages and the head of ResNet-18 or ResNet-50, narrow.
struct SmallResNet : nn::Module {
  explicit SmallResNet(bool bottleneck) {
    stem = register_module("stem", ConvNorm(3, 8, 7, 2));
    int64_t width = 8;
    for (int64_t stage = 0; stage < 4; ++stage) {
      for (int64_t i = 0; i < 2; ++i) {
        const int64_t to = 8 * (1 + stage);
        blocks.push_back(register_module(fmt::format("block{}_{}", stage, i),
                                         Block(width, to, stage > 0 && i == 0 ? 2 : 1, bottleneck)));
        width = to;
      }
    }
    head = register_module("head", nn::Linear(width, 6));
    eval();
  }
  torch::Tensor forward(const torch::Tensor& x) {
    // The normalisation of a colour image.
    const auto mean = torch::tensor({0.485f, 0.456f, 0.406f}).view({1, 3, 1, 1});
    const auto deviation = torch::tensor({0.229f, 0.224f, 0.225f}).view({1, 3, 1, 1});
    torch::Tensor y = torch::max_pool2d(stem((x - mean) / deviation).relu(), 3, 2, 1);
    for (auto& block : blocks) y = block(y);
    y = nn::functional::adaptive_avg_pool2d(y, nn::functional::AdaptiveAvgPool2dFuncOptions(1));
    return head(torch::dropout(y.view({y.size(0), -1}), 0.5, is_training()));
  }
  ConvNorm stem{nullptr};
  std::vector<Block> blocks;
  nn::Linear head{nullptr};
};

/// Skip connections, three kinds of up-sampling, heat maps; points by soft-argmax.
struct SmallUNet : nn::Module {
  SmallUNet() {
    down1 = register_module("down1", ConvNorm(3, 6, 3));
    down2 = register_module("down2", ConvNorm(6, 8, 3));
    down3 = register_module("down3", ConvNorm(8, 8, 3));
    bottom = register_module("bottom", ConvNorm(8, 8, 3));
    up3 = register_module("up3", nn::ConvTranspose2d(nn::ConvTranspose2dOptions(8, 8, 4).stride(2).padding(1)));
    join2 = register_module("join2", ConvNorm(16, 8, 3));
    join1 = register_module("join1", ConvNorm(16, 6, 3));
    heat = register_module("heat", nn::Conv2d(nn::Conv2dOptions(12, 5, 1)));
    eval();
  }
  /// x in 0 .. 1 from left to right, y from top to bottom, for each of 5 heat maps.
  torch::Tensor forward(const torch::Tensor& image) {
    const auto halved = [](const torch::Tensor& x) { return torch::max_pool2d(x, 2); };
    const torch::Tensor a = torch::leaky_relu(down1(image), 0.1), b = down2(halved(a)).relu(),
                        c = torch::elu(down3(halved(b)));
    torch::Tensor x = up3(bottom(halved(c)).tanh());
    x = join2(torch::cat({x, c}, 1)).relu();
    x = torch::upsample_bilinear2d(x, {8, 8}, /*align_corners=*/false);
    x = join1(torch::cat({x, b}, 1)).sigmoid();
    x = torch::upsample_nearest2d(x, {16, 16});
    x = heat(torch::cat({x, torch::upsample_bilinear2d(torch::avg_pool2d(a, 2), {16, 16}, /*align_corners=*/true)}, 1));
    const torch::Tensor share = (x * 10).flatten(2).softmax(-1).view({x.size(0), 5, 16, 16});
    const torch::Tensor ramp = torch::linspace(0, 1, 16);
    return torch::stack({(share.sum(2) * ramp).sum(-1), share.sum(3).matmul(ramp)}, -1);
  }
  ConvNorm down1{nullptr}, down2{nullptr}, down3{nullptr}, bottom{nullptr}, join2{nullptr}, join1{nullptr};
  nn::ConvTranspose2d up3{nullptr};
  nn::Conv2d heat{nullptr};
};

template <class Network>
void ExpectParity(Network& network, const std::vector<int64_t>& shape) {
  at::NoGradGuard no_grad;
  const testing::TempDir folder;
  const auto function = TestFunction(shape, [&](const torch::Tensor& x) { return network.forward(x); });
  WriteFileAtomically(folder / "model.onnx", ExportToOnnx(network, function).SerializeAsString());
  const ParityReport report = CheckParity(folder / "model.onnx", function, 1, folder.path());
  ASSERT_EQ(report.others.size(), 1u);
  EXPECT_TRUE(report.others[0].agrees()) << report.others[0].refusal.value_or("")
                                         << report.others[0].max_relative_diff.value_or(-1);
  if (!report.runtime.has_value()) GTEST_SKIP() << "no ONNX Runtime here; run ./dev setup";
  EXPECT_LT(report.max_abs_diff(), 2e-5);
}

TEST(WholeNetworks, ResNetHasTheOutputsOfLibTorch) {
  torch::manual_seed(5);
  at::NoGradGuard no_grad;
  SmallResNet network(/*bottleneck=*/false);
  ExpectParity(network, {3, 48, 48});
}

TEST(WholeNetworks, ResNetOfBottlenecksHasTheOutputsOfLibTorch) {
  torch::manual_seed(6);
  at::NoGradGuard no_grad;
  SmallResNet network(/*bottleneck=*/true);
  ExpectParity(network, {3, 48, 48});
}

TEST(WholeNetworks, UNetWithHeatMapsHasTheOutputsOfLibTorch) {
  torch::manual_seed(7);
  at::NoGradGuard no_grad;
  SmallUNet network;
  ExpectParity(network, {3, 16, 16});
}

TEST(WholeNetworks, ImagesAndMatricesMeetInEveryRuntime) {
  const testing::TempDir folder;
  ExportedFunction function = TestFunction({5, 3, 4}, [](const torch::Tensor& x) { return x; });
  function.inputs.push_back(TestFunction({6}, [](const torch::Tensor& x) { return x; }).inputs[0]);
  function.inputs[1].name = "shape";
  function.forward = [](const std::vector<torch::Tensor>& inputs) {
    return std::vector<torch::Tensor>{torch::cat({inputs[0].flatten(1), inputs[1]}, 1)};
  };
  WriteFileAtomically(folder / "model.onnx", ExportToOnnx(Weights(), function).SerializeAsString());
  const ParityReport report = CheckParity(folder / "model.onnx", function, 1, folder.path());
  EXPECT_TRUE(report.others.at(0).agrees()) << report.others[0].refusal.value_or("");
}

}  // namespace
}  // namespace daumier::exporting
