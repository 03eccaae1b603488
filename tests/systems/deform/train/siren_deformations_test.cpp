#include "systems/deform/train/siren_deformations.h"

#include "tests/support/deform_networks.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::deform {
namespace {

using testing::SmallDeformOptions;
using testing::SomeTemplate;

/// As published: a SIREN of 50,435 parameters.
HypernetworkDeformation Published() {
  torch::manual_seed(2);
  return {DeformOptions{}, SomeTemplate(), {}};
}

double Deviation(const torch::Tensor& numbers) {
  return numbers.std().item<double>();
}

// Counted by hand: ten branches of 128 * 256 + 256 + 256 * 256 + 256 = 98,816 before their last layers, which have
// 257 numbers for each of the SIREN's 50,435.
TEST(HypernetworkDeformation, HasAsManyParametersAsTheAuthorsProgram) {
  EXPECT_EQ(Published().num_parameters(), 13949955);
  EXPECT_EQ(10 * 98816 + 257 * 50435, 13949955);
}

// The authors' program, measured: weights of 0.195 in layer 0 and 0.0046 in the others, which differ by 1e-4 from code
// to code; displacements of 0.034, which differ by 0.003.
TEST(HypernetworkDeformation, BeginsAsTheAuthorsProgramDoes) {
  auto network = Published();
  const torch::Tensor codes = torch::randn({16, 128}) * 0.01;
  const at::NoGradGuard no_grad;
  const torch::Tensor parameters = network.SirenParameters(codes);
  const runtime::SirenLayout siren;
  const auto weights = [&](int layer) {
    return parameters.slice(1, siren.weight_offset(layer), siren.bias_offset(layer));
  };
  EXPECT_NEAR(Deviation(weights(0)), 1 / 3.0 / std::sqrt(3.0), 0.02);
  for (int layer = 1; layer < 5; ++layer) EXPECT_NEAR(Deviation(weights(layer)), 1 / 128.0 / std::sqrt(3.0), 3e-4);
  EXPECT_LT((parameters - parameters[0]).abs().mean().item<double>(), 3e-4);
  EXPECT_GT((parameters - parameters[0]).abs().mean().item<double>(), 3e-5);
  const torch::Tensor displacements = network.DeformVertices(codes) - network.template_vertices();
  const double size = displacements.square().sum(2).mean().sqrt().item<double>();
  EXPECT_GT(size, 0.005);
  EXPECT_LT(size, 0.15);
  EXPECT_LT((displacements - displacements[0]).abs().max().item<double>(), 0.2 * size);
}

TEST(ConditionedDeformation, TheCodeMovesTheBiasesOfTheFirstAndTheMiddleLayerAlone) {
  torch::manual_seed(3);
  ConditionedDeformation network(SmallDeformOptions("conditioning"), SomeTemplate(), {});
  const at::NoGradGuard no_grad;
  const torch::Tensor parameters = network.SirenParameters(torch::randn({2, 8}));
  const torch::Tensor differs = (parameters[0] != parameters[1]);
  const runtime::SirenLayout siren = network.options().siren();
  const int mid = siren.num_layers() / 2;
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    const bool reads_code = layer == 0 || layer == mid;
    EXPECT_FALSE(differs.slice(0, siren.weight_offset(layer), siren.bias_offset(layer)).any().item<bool>());
    EXPECT_EQ(differs.slice(0, siren.bias_offset(layer), siren.weight_offset(layer + 1)).any().item<bool>(),
              reads_code);
  }
}

// A code concatenated to the input of a layer: W [x, z] + b = W_x x + (b + W_z z).
TEST(ConditionedDeformation, IsASirenOfInputAndCodeConcatenated) {
  torch::manual_seed(3);
  ConditionedDeformation network(SmallDeformOptions("conditioning"), SomeTemplate(), {});
  const at::NoGradGuard no_grad;
  const auto p = network.named_parameters();
  const runtime::SirenLayout siren = network.options().siren();
  const torch::Tensor code = torch::randn({1, 8}) * 0.1;
  torch::Tensor x = SomeTemplate();
  for (int layer = 0; layer < siren.num_layers(); ++layer) {
    torch::Tensor weights =
        p["shared"].slice(0, siren.weight_offset(layer), siren.bias_offset(layer)).reshape({siren.outputs(layer), -1});
    const torch::Tensor bias = p["shared"].slice(0, siren.bias_offset(layer), siren.weight_offset(layer + 1));
    if (layer == 0 || layer == siren.num_layers() / 2) {
      weights = torch::cat({weights, p[layer == 0 ? "first_code" : "mid_code"]}, 1);
      x = torch::cat({x, code.expand({x.size(0), -1})}, 1);
    }
    x = torch::matmul(x, weights.t()) + bias;
    if (layer + 1 < siren.num_layers()) x = torch::sin(x * siren.omega);
  }
  EXPECT_TRUE(torch::allclose(network.DeformVertices(code)[0], SomeTemplate() + x, 1e-4, 1e-5));
}

TEST(SirenDeformation, OverfitsEightFaces) {
  for (const std::string kind : {"hypernetwork", "conditioning"}) {
    SCOPED_TRACE(kind);
    torch::manual_seed(4);
    EXPECT_LT(testing::ErrorAfterOverfitting(SmallDeformOptions(kind), 200, 2e-4), 0.02);
  }
}

}  // namespace
}  // namespace daumier::deform
