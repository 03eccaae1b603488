#include "models/sketch_network.h"

#include "tensor/eigen.h"
#include "tests/support/expect_error.h"
#include "tests/support/random_bilinear.h"

#include <torch/torch.h>

namespace daumier::models {
namespace {

using testing::ExpectError;
using testing::RandomBilinear;

constexpr PixelCnnOptions kSmall{.resolution = 32, .width = 4, .hidden = 16};

SketchNetwork SmallNetwork(const faces::BilinearModel& bilinear) {
  torch::manual_seed(5);
  return SketchNetwork(kSmall, bilinear);
}

TEST(SketchNetwork, AnswersCoefficientsAndVerticesForAnyBatch) {
  auto network = SmallNetwork(RandomBilinear(10, 6, 3, 1));
  for (const int64_t batch : {1, 2, 5}) {
    const auto answer = network->forward(torch::rand({batch, 1, 32, 32}));
    EXPECT_EQ(answer.u.sizes().vec(), (std::vector<int64_t>{batch, 6}));
    EXPECT_EQ(answer.v.sizes().vec(), (std::vector<int64_t>{batch, 3}));
    EXPECT_EQ(network->Decode(answer).sizes().vec(), (std::vector<int64_t>{batch, 30}));
  }
  EXPECT_EQ(network->num_identity(), 6);
  EXPECT_EQ(network->num_expression(), 3);
  EXPECT_EQ(network->num_vertices(), 10);
}

TEST(SketchNetwork, TakesEveryResolutionOfItsOptions) {
  for (const int resolution : {32, 50, 128}) {
    SketchNetwork network(PixelCnnOptions{resolution, 2, 8}, RandomBilinear(2, 2, 2, 1));
    EXPECT_NO_THROW(network->forward(torch::rand({2, 1, resolution, resolution})));
  }
}

TEST(SketchNetwork, NumParametersIsTheSumOverItsLayers) {
  // 32 -> 16 -> 8 -> 4 with 4, 8, 16 channels; each convolution 9 in out weights and a batch norm of 2 out; 16 * 4 * 4
  // features.
  const int64_t convolutions = 9 * (1 * 4 + 4 * 8 + 8 * 16) + 2 * (4 + 8 + 16);
  const int64_t shared = 256 * 16 + 16;
  const int64_t identity = 2 * (16 * 16 + 16) + 16 * 6 + 6;
  const int64_t expression = 16 * 3 + 3;
  EXPECT_EQ(SmallNetwork(RandomBilinear(10, 6, 3, 1))->num_parameters(), convolutions + shared + identity + expression);
}

TEST(SketchNetwork, DecodeEqualsReconstruct) {
  const auto bilinear = RandomBilinear(10, 6, 3, 2);
  auto network = SmallNetwork(bilinear);
  torch::manual_seed(1);
  const FaceCoefficients coefficients{torch::randn({4, 6}), torch::randn({4, 3})};
  const auto faces = tensor::CopyToMatrix<float>(network->Decode(coefficients));
  for (int face = 0; face < 4; ++face) {
    const Eigen::VectorXf u = tensor::CopyToMatrix<float>(coefficients.u).row(face);
    const Eigen::VectorXf v = tensor::CopyToMatrix<float>(coefficients.v).row(face);
    EXPECT_LT((faces.row(face).transpose() - faces::Reconstruct(bilinear, u, v)).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(SketchNetwork, AnswersAreStandardisedOverTheFittedFaces) {
  auto bilinear = RandomBilinear(10, 6, 3, 3);
  bilinear.identity_factors.col(2).setConstant(0.25f);  // Does not vary: the floor keeps it alive.
  auto network = SmallNetwork(bilinear);
  network->eval();
  const auto images = torch::rand({3, 1, 32, 32});
  const auto before = network->forward(images);
  // An answer of zeros is the mean; one of ones lies a deviation away, here made by the last layers' biases.
  torch::NoGradGuard no_grad;
  for (auto& item : network->named_parameters()) {
    if (item.key() == "identity.4.weight" || item.key() == "expression.0.weight") item.value().zero_();
    if (item.key() == "identity.4.bias" || item.key() == "expression.0.bias") item.value().fill_(1);
  }
  const auto after = network->forward(images);
  for (int k = 0; k < 6; ++k) {
    const auto column = bilinear.identity_factors.col(k);
    const float deviation = std::sqrt((column.array() - column.mean()).square().mean());
    const float expected = column.mean() + deviation;
    const float answer = after.u[0][k].item<float>();
    if (k == 2) {
      EXPECT_GT(answer, 0.25f);
      EXPECT_LT(answer, 0.27f);
    } else {
      EXPECT_NEAR(answer, expected, 1e-5);
    }
  }
  EXPECT_TRUE(torch::equal(after.v[0], after.v[2]));
}

TEST(SketchNetwork, EvaluationIsDeterministicAndTakesEachSketchAlone) {
  auto network = SmallNetwork(RandomBilinear(10, 6, 3, 1));
  network->forward(torch::rand({8, 1, 32, 32}));  // Moves the batch norms.
  network->eval();
  const auto images = torch::rand({4, 1, 32, 32});
  const auto together = network->forward(images);
  EXPECT_TRUE(torch::equal(together.u, network->forward(images).u));
  const auto alone = network->forward(images.slice(0, 2, 3));
  EXPECT_TRUE(torch::allclose(together.u.slice(0, 2, 3), alone.u, 1e-5, 1e-6));
  EXPECT_TRUE(torch::allclose(together.v.slice(0, 2, 3), alone.v, 1e-5, 1e-6));
}

TEST(SketchNetwork, StateHoldsTheBilinearModel) {
  const auto bilinear = RandomBilinear(10, 6, 3, 1);
  auto network = SmallNetwork(bilinear);
  const auto buffers = network->named_buffers();
  EXPECT_TRUE(torch::equal(buffers["core"], tensor::CopyToTensor(bilinear.core)));
  for (const char* name : {"u_mean", "u_deviation", "v_mean", "v_deviation"}) EXPECT_TRUE(buffers.contains(name));
}

TEST(SketchNetwork, OverfitsEightSketchesByTheirVertices) {
  const auto bilinear = RandomBilinear(10, 6, 3, 4);
  auto network = SmallNetwork(bilinear);
  torch::manual_seed(6);
  const auto images = (torch::rand({8, 1, 32, 32}) < 0.1).to(torch::kFloat32);
  const auto u = torch::randn({8, 6}), v = torch::randn({8, 3});
  const auto target = network->Decode({u, v});
  torch::optim::Adam adam(network->parameters(), torch::optim::AdamOptions(3e-3));
  double first = 0, last = 0;
  for (int step = 0; step < 400; ++step) {
    adam.zero_grad();
    const auto error = (network->Decode(network->forward(images)) - target).square().mean();
    error.backward();
    adam.step();
    last = error.item<double>();
    if (step == 0) first = last;
  }
  EXPECT_LT(last, 0.01 * first);
}

TEST(SketchNetwork, RefusesOtherShapes) {
  auto network = SmallNetwork(RandomBilinear(10, 6, 3, 1));
  ExpectError([&] { network->forward(torch::rand({2, 1, 32, 31})); }, "images has shape (2, 1, 32, 31)");
  ExpectError([&] { network->forward(torch::rand({2, 3, 32, 32})); }, "images has shape (2, 3, 32, 32)");
  ExpectError(
      [&] {
        network->Decode({torch::rand({2, 6}), torch::rand({2, 4})});
      },
      "v has shape (2, 4), expected (2, 3)");
  auto bilinear = RandomBilinear(10, 6, 3, 1);
  bilinear.num_identity = 7;
  ExpectError([&] { SketchNetwork(kSmall, bilinear); }, "core of the bilinear model is 18 x 30");
}

}  // namespace
}  // namespace daumier::models
