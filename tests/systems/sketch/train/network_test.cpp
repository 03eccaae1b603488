#include "systems/sketch/train/network.h"

#include "tensor/eigen.h"
#include "tests/support/expect_error.h"
#include "tests/support/sketch_networks.h"

#include <torch/linalg.h>
#include <torch/nn/modules/conv.h>
#include <torch/optim.h>
#include <torch/utils.h>

#include <set>

namespace daumier::sketch {
namespace {

using testing::ExpectError;
using testing::RandomModels;
using testing::RandomSketchInput;
using testing::SmallSketchNetworks;

const SketchNetworkOptions kSmall{.resolution = 32, .width = 8, .hidden = 16, .branch = 16};

SketchNetwork SmallNetwork(const SketchNetworkOptions& options = kSmall) {
  torch::manual_seed(5);
  return SketchNetwork(options, RandomModels(10, options.residual));
}

int64_t Parameters(const SketchNetworkOptions& options, const FittedModels& models) {
  return SketchNetwork(options, models)->num_parameters();
}

TEST(SketchNetwork, EveryKindPredictsCoefficientsAndVerticesForAnyBatch) {
  for (const auto& [name, options] : SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    auto network = SmallNetwork(options);
    for (const int64_t batch : {2, 5}) {
      const auto predicted = network->forward(RandomSketchInput(options, batch));
      EXPECT_EQ(predicted.u.sizes().vec(), (std::vector<int64_t>{batch, 6}));
      EXPECT_EQ(predicted.v.sizes().vec(), (std::vector<int64_t>{batch, 3}));
      EXPECT_EQ(predicted.residual.defined(), options.residual > 0);
      EXPECT_EQ(network->Decode(predicted).sizes().vec(), (std::vector<int64_t>{batch, 30}));
    }
    EXPECT_EQ(network->num_vertices(), 10);
  }
}

TEST(SketchNetwork, ReadsWhatItsOptionsSayAndNothingElse) {
  for (const auto& [name, options] : SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    auto network = SmallNetwork(options);
    network->eval();
    const SketchInput all = RandomSketchInput(options, 2), others = RandomSketchInput(options, 2);
    const auto predicted = network->Decode(network->forward(all));
    const auto changes = [&](const SketchInput& input) {
      return !torch::equal(network->Decode(network->forward(input)), predicted);
    };
    EXPECT_EQ(changes({others.images, all.points, all.shape}), options.reads_image());
    EXPECT_EQ(changes({all.images, others.points, all.shape}), options.reads_points());
    EXPECT_EQ(changes({all.images, all.points, others.shape}), options.reads_shape());
  }
}

TEST(SketchNetwork, CompactParametersAreTheSumOverItsLayers) {
  // 32 -> 16 -> 8 -> 4 with 8, 16, 32 channels; each convolution 9 in out weights and a batch norm of 2 out; 32 * 4 * 4
  // features.
  const int64_t convolutions = 9 * (1 * 8 + 8 * 16 + 16 * 32) + 2 * (8 + 16 + 32);
  const int64_t shared = 512 * 16 + 16;
  const int64_t identity = 2 * (16 * 16 + 16) + 16 * 6 + 6;
  const int64_t expression = 16 * 3 + 3;
  EXPECT_EQ(SmallNetwork()->num_parameters(), convolutions + shared + identity + expression);
}

TEST(SketchNetwork, AsPrintedHasThePrintedLayers) {
  // [Han et al. 2017, section 4.3 and figure 7] with 256 x 256 pixels, 50 + 16 weights and shape-level numbers.
  const int64_t convolutions = (11 * 11 * 1 + 1) * 96 + (5 * 5 * 96 + 1) * 256 + (3 * 3 * 256 + 1) * 384 +
                               (3 * 3 * 384 + 1) * 384 + (3 * 3 * 384 + 1) * 256;
  const int64_t features = (7 * 7 * 256 + 1) * 4096;
  const int64_t u_layers = 4097 * 1024 + 2 * 1025 * 1024, v_layers = 4097 * 1024;
  const int64_t pixel = convolutions + features + u_layers + v_layers;
  FittedModels models{testing::RandomBilinear(3, 50, 16, 1), testing::RandomBilinear(3, 50, 16, 2), {}};
  SketchNetworkOptions printed{.trunk = "alexnet",
                               .resolution = 256,
                               .width = 96,
                               .batch_norm = false,
                               .hidden = 4096,
                               .branch = 1024,
                               .identity_layers = 3,
                               .expression_layers = 1};
  EXPECT_EQ(Parameters(printed, models), pixel + 1025 * 50 + 1025 * 16);
  EXPECT_EQ(Parameters(printed, models), 65665794);
  printed.shape_input = "late";
  EXPECT_EQ(Parameters(printed, models), pixel + 2 * 67 * 512 + 1537 * 50 + 1537 * 16);
  printed.shape_input = "early";
  EXPECT_EQ(Parameters(printed, models), pixel + 2 * 66 * 1024 + 1025 * 50 + 1025 * 16);
  printed.shape_input = "none";
  printed.branches = "one";
  EXPECT_EQ(Parameters(printed, models), convolutions + features + u_layers + 1025 * 50 + 1025 * 16);
}

TEST(SketchNetwork, DecodeEqualsReconstruct) {
  auto network = SmallNetwork();
  const auto bilinear = RandomModels(10).bilinear;
  torch::manual_seed(1);
  const FaceCoefficients coefficients{torch::randn({4, 6}), torch::randn({4, 3}), {}};
  const auto faces = tensor::CopyToMatrix<float>(network->Decode(coefficients));
  for (int face = 0; face < 4; ++face) {
    const Eigen::VectorXf u = tensor::CopyToMatrix<float>(coefficients.u).row(face);
    const Eigen::VectorXf v = tensor::CopyToMatrix<float>(coefficients.v).row(face);
    EXPECT_LT((faces.row(face).transpose() - faces::Reconstruct(bilinear, u, v)).cwiseAbs().maxCoeff(), 1e-4);
  }
}

TEST(SketchNetwork, ResidualIsAddedInABasisThatHoldsTheBilinearFace) {
  // With all 30 directions of an orthonormal basis nothing of the bilinear face is lost.
  const SketchNetworkOptions options{.resolution = 32, .width = 8, .hidden = 16, .residual = 30};
  FittedModels models = RandomModels(10, 30);
  models.basis.rows = Eigen::MatrixXf(models.basis.rows).householderQr().householderQ();
  SketchNetwork network(options, models);
  torch::manual_seed(1);
  const auto u = torch::randn({4, 6}), v = torch::randn({4, 3}), residual = torch::randn({4, 30});
  const auto bilinear = SmallNetwork()->Decode({u, v, {}});
  EXPECT_TRUE(torch::allclose(network->Decode({u, v, torch::zeros({4, 30})}), bilinear, 1e-4, 1e-4));
  EXPECT_TRUE(torch::allclose(network->Decode({u, v, residual}),
                              bilinear + residual.mm(tensor::CopyToTensor(models.basis.rows)), 1e-4, 1e-4));
}

TEST(SketchNetwork, OutputsAreStandardisedOverTheFittedFaces) {
  FittedModels models = RandomModels(10);
  models.bilinear.identity_factors.col(2).setConstant(0.25f);  // Does not vary: the floor keeps it alive.
  torch::manual_seed(5);
  SketchNetwork network(kSmall, models);
  network->eval();
  const auto input = RandomSketchInput(kSmall, 3);
  // An output of zeros is the mean; one of ones lies a deviation away, here made by the output layers' biases.
  torch::NoGradGuard no_grad;
  for (auto& item : network->named_parameters()) {
    if (item.key() == "identity_output.weight" || item.key() == "expression_output.weight") item.value().zero_();
    if (item.key() == "identity_output.bias" || item.key() == "expression_output.bias") item.value().fill_(1);
  }
  const auto after = network->forward(input);
  for (int k = 0; k < 6; ++k) {
    const auto column = models.bilinear.identity_factors.col(k);
    const float deviation = std::sqrt((column.array() - column.mean()).square().mean());
    const float expected = column.mean() + deviation;
    const float predicted = after.u[0][k].item<float>();
    if (k == 2) {
      EXPECT_GT(predicted, 0.25f);
      EXPECT_LT(predicted, 0.27f);
    } else {
      EXPECT_NEAR(predicted, expected, 1e-5);
    }
  }
  EXPECT_TRUE(torch::equal(after.v[0], after.v[2]));
  const auto standardised = network->Standardised(after);
  EXPECT_TRUE(torch::allclose(standardised.u, torch::ones({3, 6}), 1e-3, 1e-3));
  EXPECT_TRUE(torch::allclose(standardised.v, torch::ones({3, 3}), 1e-3, 1e-3));
}

TEST(SketchNetwork, EvaluationIsDeterministicAndTakesEachSketchAlone) {
  for (const auto& [name, options] : SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    auto network = SmallNetwork(options);
    network->forward(RandomSketchInput(options, 8));  // Moves the batch norms.
    network->eval();
    const auto input = RandomSketchInput(options, 4);
    const auto together = network->Decode(network->forward(input));
    EXPECT_TRUE(torch::equal(together, network->Decode(network->forward(input))));
    const auto alone =
        network->forward({input.images.slice(0, 2, 3), input.points.slice(0, 2, 3), input.shape.slice(0, 2, 3)});
    EXPECT_TRUE(torch::allclose(together.slice(0, 2, 3), network->Decode(alone), 1e-4, 1e-4));
  }
}

TEST(SketchNetwork, FrozenConvolutionsNeitherLearnNorUpdateNormalisation) {
  const SketchNetworkOptions options = SmallSketchNetworks().at("PixelCNN");
  auto network = SmallNetwork(options);
  network->train();
  network->FreezeConvolutions(true);
  network->train();  // As a trainer does after each validation.
  const auto statistics = [&] { return network->named_buffers()["convolutions.1.running_mean"].clone(); };
  const auto before = statistics();
  network->Decode(network->forward(RandomSketchInput(options, 4))).sum().backward();
  EXPECT_TRUE(torch::equal(statistics(), before));
  for (const auto& item : network->named_parameters()) {
    const bool convolution = item.key().rfind("convolutions.", 0) == 0;
    EXPECT_EQ(item.value().grad().defined(), !convolution) << item.key();
  }
  network->FreezeConvolutions(false);
  network->forward(RandomSketchInput(options, 4)).u.sum().backward();
  EXPECT_FALSE(torch::equal(statistics(), before));
  EXPECT_TRUE(network->named_parameters()["convolutions.0.weight"].grad().defined());
}

/// Gradients of the convolutions' weights, by the name of the parameter.
std::map<std::string, torch::Tensor> ConvolutionGradients(const SketchNetworkOptions& options,
                                                          const torch::Tensor& images, torch::ScalarType type) {
  auto network = SmallNetwork(options);
  network->to(type);
  network->train();
  network->Decode(network->forward({images.to(type), {}, {}})).square().mean().backward();
  std::map<std::string, torch::Tensor> gradients;
  for (const auto& item : network->named_parameters())
    if (item.key().rfind("convolutions.", 0) == 0 && item.value().dim() == 4)
      gradients[item.key()] = item.value().grad().to(torch::kFloat64);
  return gradients;
}

// What a convolution reads or writes beyond its channels is seen in its gradients, or as a corrupted heap. In float64
// LibTorch computes by itself.
TEST(SketchNetwork, OfEveryWidthHasTheGradientsOfFloat64) {
  for (const auto& [trunk, width] : std::vector<std::pair<std::string, int>>{{"compact", 4},
                                                                             {"compact", 8},
                                                                             {"compact", 12},
                                                                             {"residual", 1},
                                                                             {"residual", 4},
                                                                             {"residual", 5},
                                                                             {"residual", 8},
                                                                             {"alexnet", 12},
                                                                             {"alexnet", 24}}) {
    SketchNetworkOptions options = kSmall;
    options.trunk = trunk;
    options.width = width;
    options.resolution = trunk == "alexnet" ? 64 : 32;
    for (const int64_t batch : {1, 3, 4}) {
      SCOPED_TRACE(fmt::format("{} of width {}, batch {}", trunk, width, batch));
      torch::manual_seed(4);
      const auto images = ChannelsLast(torch::rand({batch, 1, options.resolution, options.resolution}));
      const auto exact = ConvolutionGradients(options, images, torch::kFloat64);
      for (const auto& [name, gradient] : ConvolutionGradients(options, images, torch::kFloat32))
        EXPECT_LT((gradient - exact.at(name)).norm().item<double>(), 1e-3 * exact.at(name).norm().item<double>())
            << name;
    }
  }
}

TEST(SketchNetwork, OfAWidthThatATrainingRefusesTakesSketchesInEitherLayout) {
  SketchNetworkOptions options = kSmall;
  options.trunk = "residual";
  options.width = 4;
  auto network = SmallNetwork(options);
  network->eval();
  const auto images = RandomSketchInput(options, 3).images;
  const auto predicted = network->Decode(network->forward({images, {}, {}}));
  EXPECT_TRUE(torch::equal(network->Decode(network->forward({ChannelsLast(images), {}, {}})), predicted));
}

TEST(SketchNetwork, PointsMayComeInAnyOrder) {
  const SketchNetworkOptions options = SmallSketchNetworks().at("points");
  auto network = SmallNetwork(options);
  network->eval();
  SketchInput input = RandomSketchInput(options, 2);
  const auto predicted = network->forward(input).u;
  input.points = input.points.index_select(2, torch::randperm(options.num_points));
  EXPECT_TRUE(torch::allclose(network->forward(input).u, predicted, 1e-5, 1e-6));
}

TEST(SketchNetwork, EveryKindOverfitsEightSketchesByTheirVertices) {
  for (const auto& [name, options] : SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    auto network = SmallNetwork(options);
    torch::manual_seed(6);
    const auto input = RandomSketchInput(options, 8);
    const auto u = torch::randn({8, 6}), v = torch::randn({8, 3});
    const auto target = SmallNetwork(SmallSketchNetworks().at("compact"))->Decode({u, v, {}});
    torch::optim::Adam adam(network->parameters(), torch::optim::AdamOptions(3e-3));
    // A basis of 8 directions does not hold these faces: what is learnt is their part in it.
    const double unreachable = options.residual == 0
                                   ? 0
                                   : (target - target.mm(torch::linalg_pinv(network->basis())).mm(network->basis()))
                                         .square()
                                         .mean()
                                         .item<double>();
    double first = 0, last = 0;
    for (int step = 0; step < 800 && (step == 0 || last > 0.02 * first); ++step) {
      adam.zero_grad();
      const auto error = (network->Decode(network->forward(input)) - target).square().mean();
      error.backward();
      adam.step();
      last = error.item<double>() - unreachable;
      if (step == 0) first = last;
    }
    EXPECT_LE(last, 0.02 * first);
  }
}

TEST(SketchNetwork, RefusesOtherShapes) {
  auto network = SmallNetwork();
  ExpectError([&] { network->forward({torch::rand({2, 1, 32, 31}), {}, {}}); }, "images has shape (2, 1, 32, 31)");
  ExpectError(
      [&] {
        network->Decode({torch::rand({2, 6}), torch::rand({2, 4}), {}});
      },
      "v has shape (2, 4), expected (2, 3)");
  auto shape_network = SmallNetwork(SmallSketchNetworks().at("ShapeNN"));
  ExpectError([&] { shape_network->forward({{}, {}, torch::rand({2, 5})}); }, "shape has shape (2, 5)");
  FittedModels models = RandomModels(10);
  models.bilinear.num_identity = 7;
  ExpectError([&] { SketchNetwork(kSmall, models); }, "core of the bilinear model is 18 x 30");
  SketchNetworkOptions options = kSmall;
  options.residual = 4;
  ExpectError([&] { SketchNetwork(options, RandomModels(10, 3)); }, "the basis is 3 x 30, expected 4 x 30");
  options = kSmall;
  options.trunk = "shape";
  options.shape_input = "late";
  ExpectError([&] { SketchNetwork(options, RandomModels(10)); }, "network.shape_input has to be \"none\"");
}

TEST(SketchNetworkOptions, HasWholeBlocksWhereAllChannelsAreMultiplesOfEight) {
  for (const std::string& trunk : TrunkNames()) {
    for (int width = 1; width <= 48; ++width) {
      const SketchNetworkOptions options{.trunk = trunk, .resolution = 64, .width = width, .hidden = 1};
      bool whole = true;
      for (const auto& layer : models::MakeSketchTrunk(TrunkOf(options, 6)).convolutions->modules()) {
        if (const auto* convolution = layer->as<torch::nn::Conv2d>())
          whole = whole && convolution->options.out_channels() % 8 == 0;
        if (const auto* convolution = layer->as<torch::nn::Conv1d>())
          whole = whole && convolution->options.out_channels() % 8 == 0;
      }
      EXPECT_EQ(options.has_whole_blocks(), whole) << trunk << " of width " << width;
    }
  }
}

TEST(SketchNetworkOptions, BothHalvesOfTheTableOfTrunksHaveTheSameRows) {
  const std::vector<std::string> options = TrunkNames(), layers = models::SketchTrunkNames();
  EXPECT_EQ(std::set<std::string>(options.begin(), options.end()), std::set<std::string>(layers.begin(), layers.end()));
}

TEST(SketchNetwork, EveryTrunkEndsInHiddenFeatures) {
  for (const auto& [name, options] : testing::SmallSketchNetworks()) {
    SCOPED_TRACE(name);
    models::SketchTrunk trunk = models::MakeSketchTrunk(TrunkOf(options, 6));
    const SketchInput input = testing::RandomSketchInput(options, 3);
    torch::Tensor features = input.shape;
    if (options.reads_image()) features = trunk.convolutions->forward(input.images);
    if (options.reads_points()) features = trunk.convolutions->forward(input.points);
    EXPECT_EQ(trunk.features->forward(features).sizes().vec(), (std::vector<int64_t>{3, options.hidden}));
  }
}

}  // namespace
}  // namespace daumier::sketch
