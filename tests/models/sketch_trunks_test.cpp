#include "models/sketch_trunks.h"

#include "tensor/autocast.h"
#include "tests/support/expect_error.h"

#include <torch/nn/modules/conv.h>
#include <torch/utils.h>

#include <string>
#include <vector>

namespace daumier::models {
namespace {

std::vector<int64_t> ConvolutionSizes(const TrunkOptions& options) {
  SketchTrunk trunk = MakeSketchTrunk(options);
  return trunk.convolutions->forward(torch::rand({2, 1, options.resolution, options.resolution})).sizes().vec();
}

TEST(SketchConvolution, StaysInFloat32AndReturnsWhatAutocastPromises) {
  torch::manual_seed(1);
  SketchConvolution convolution(torch::nn::Conv2dOptions(1, 4, 5).stride(2));
  const torch::Tensor sketches = torch::rand({2, 1, 16, 16}), exact = convolution->forward(sketches);
  EXPECT_EQ(exact.scalar_type(), torch::kFloat32);
  const tensor::Autocast guard(torch::kCPU, true);
  EXPECT_TRUE(torch::equal(convolution->forward(sketches), exact.to(torch::kBFloat16)));
}

TEST(SketchTrunks, AlexNetHasTheSidesOfItsPadding) {
  TrunkOptions options{.kind = "alexnet", .resolution = 256, .width = 24};
  EXPECT_EQ(ConvolutionSizes(options), (std::vector<int64_t>{2, 64, 7, 7}));
  options.resolution = 128;
  EXPECT_EQ(ConvolutionSizes(options), (std::vector<int64_t>{2, 64, 3, 3}));
  options.resolution = 64;
  EXPECT_EQ(ConvolutionSizes(options), (std::vector<int64_t>{2, 64, 1, 1}));
  options.resolution = 48;
  testing::ExpectError([&] { MakeSketchTrunk(options); }, "network.resolution=48 is too small");
}

TEST(SketchTrunks, ResidualEndsAtSideFourOrLessWithTheWidth) {
  for (const int resolution : {32, 50, 128}) {
    const auto sizes = ConvolutionSizes({.kind = "residual", .resolution = resolution, .width = 8});
    EXPECT_EQ(sizes[1], 8);
    EXPECT_LE(sizes[2], 4);
  }
}

TEST(SketchTrunks, CompactTakesEveryResolution) {
  for (const int resolution : {32, 50, 128}) {
    SketchTrunk trunk = MakeSketchTrunk({.kind = "compact", .resolution = resolution, .width = 8, .hidden = 8});
    const auto features =
        trunk.features->forward(trunk.convolutions->forward(torch::rand({2, 1, resolution, resolution})));
    EXPECT_EQ(features.sizes().vec(), (std::vector<int64_t>{2, 8}));
  }
}

TEST(SketchTrunks, AnUnknownKindIsRefused) {
  testing::ExpectError([] { MakeSketchTrunk({.kind = "resnet"}); },
                       "there is no trunk 'resnet' (expected compact, alexnet");
}

TEST(SketchTrunks, ShapeIsOneLayerOfTheCurveCoefficients) {
  SketchTrunk trunk = MakeSketchTrunk({.kind = "shape", .hidden = 5, .shape_size = 6});
  EXPECT_TRUE(trunk.convolutions->is_empty());
  EXPECT_EQ(trunk.features->forward(torch::rand({2, 6})).sizes().vec(), (std::vector<int64_t>{2, 5}));
}

TEST(InPlainLayout, MarksTheSameMemoryAndTheConvolutionsKeepIt) {
  for (const int64_t batch : {1, 3}) {
    const auto images = torch::rand({batch, 1, 32, 32});
    const auto last =
        torch::empty(images.sizes(), images.options().memory_format(torch::MemoryFormat::ChannelsLast)).copy_(images);
    ASSERT_EQ(last.suggest_memory_format(), torch::MemoryFormat::ChannelsLast);
    const auto plain = InPlainLayout(last);
    EXPECT_EQ(plain.data_ptr<float>(), last.data_ptr<float>());
    EXPECT_TRUE(torch::equal(plain, images));
    EXPECT_EQ(plain.strides(), images.strides());
    SketchTrunk trunk = MakeSketchTrunk({.kind = "residual", .resolution = 32, .width = 8});
    EXPECT_EQ(trunk.convolutions->forward(plain).suggest_memory_format(), torch::MemoryFormat::Contiguous);
    EXPECT_EQ(trunk.convolutions->forward(last).suggest_memory_format(), torch::MemoryFormat::ChannelsLast);
  }
}

TEST(StoreChannelsLast, ChangesNoNumberOfOutputsAndGradients) {
  for (const char* kind : {"compact", "alexnet", "residual"}) {
    const TrunkOptions options{.kind = kind, .resolution = 64, .width = kind == std::string("alexnet") ? 24 : 8};
    std::vector<SketchTrunk> trunks;
    std::vector<torch::Tensor> outputs;
    for (int i = 0; i < 2; ++i) {
      torch::manual_seed(5);
      trunks.push_back(MakeSketchTrunk(options));
      if (i == 1) StoreChannelsLast(*trunks[1].convolutions);
      torch::Tensor images = torch::rand({8, 1, 64, 64});
      images = images.as_strided(images.sizes(), {64 * 64, 1, 64, 1});
      outputs.push_back(trunks.back().convolutions->forward(images));
      outputs.back().square().sum().backward();
    }
    EXPECT_TRUE(torch::equal(outputs[0], outputs[1])) << kind;
    const auto plain = trunks[0].convolutions->parameters(), last = trunks[1].convolutions->parameters();
    for (size_t k = 0; k < plain.size(); ++k) {
      EXPECT_TRUE(torch::equal(plain[k], last[k])) << kind;
      EXPECT_TRUE(torch::equal(plain[k].grad(), last[k].grad())) << kind << " " << k;
      if (last[k].dim() == 4) {
        EXPECT_TRUE(last[k].is_contiguous(torch::MemoryFormat::ChannelsLast));
      }
    }
  }
}

TEST(ResidualBlock, WithoutItsConvolutionsIsTheShortCut) {
  torch::manual_seed(1);
  ResidualBlock block(3, 3, 1);
  block->eval();
  torch::NoGradGuard no_grad;
  for (auto& parameter : block->parameters()) parameter.zero_();
  const auto input = torch::randn({2, 3, 5, 5});
  EXPECT_TRUE(torch::equal(block->forward(input), input.relu()));
  EXPECT_EQ(ResidualBlock(3, 4, 2)->forward(input).sizes().vec(), (std::vector<int64_t>{2, 4, 3, 3}));
}

TEST(GlobalMaxPool, IsTheMaximumOfEachChannel) {
  const auto input = torch::tensor({{{1.0f, 5.0f, 2.0f}, {-3.0f, -1.0f, -2.0f}}});
  EXPECT_TRUE(torch::equal(GlobalMaxPool()->forward(input), torch::tensor({{5.0f, -1.0f}})));
}

}  // namespace
}  // namespace daumier::models
