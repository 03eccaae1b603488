#include "systems/deform/train/code_energy.h"

#include "systems/deform/train/array_deformations.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_deform.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <limits>
#include <numeric>

namespace daumier::deform {
namespace {

class CodeEnergyTest : public ::testing::Test {
 protected:
  CodeEnergyTest() { torch::manual_seed(11), code_ = 0.15 * torch::randn({8}, torch::kFloat64); }

  /// A network in float64, which computes by LibTorch's operators alone.
  std::shared_ptr<DeformNetwork> Network(const std::string& kind) const {
    auto network = testing::SmoothDeformNetwork(kind, testing::SpherePoints(20));
    network->to(torch::kFloat64);
    return network;
  }
  static AllPointsTerm AllPoints(const DeformNetwork& network) {
    return {VerticesAsPoints(network.template_vertices()), 1.1 * network.template_vertices(), 300};
  }
  static SparsePointsTerm Handles(const DeformNetwork& network) {
    const std::vector<int> vertices = {17, 3, 3};
    return {VertexPoints(network, vertices), torch::randn({3, 3}, torch::kFloat64),
            torch::tensor({0.5, 2.0, 0.0}, torch::kFloat64), 20};
  }
  static void ExpectGradient(DeformNetwork& network, const CodeEnergy& energy, const torch::Tensor& code,
                             const std::string& trace) {
    const CodeObjective objective(network, energy);
    const torch::Tensor gradient = objective.At(code).gradient;
    constexpr double kStep = 1e-5;
    for (int64_t i = 0; i < code.size(0); ++i) {
      torch::Tensor more = code.clone(), less = code.clone();
      more[i] += kStep, less[i] -= kStep;
      const double difference = (objective.At(more).energy - objective.At(less).energy) / (2 * kStep);
      EXPECT_NEAR(gradient[i].item<double>(), difference, 1e-5 * gradient.norm().item<double>()) << trace << " " << i;
    }
  }

  torch::Tensor code_;
};

TEST_F(CodeEnergyTest, EachTermHasTheGradientOfCentralDifferences) {
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    CodeEnergy surface, handles, prior;
    surface.all_points = AllPoints(*network);
    surface.prior.weight = 0;
    handles.sparse_points = {Handles(*network)};
    handles.prior.weight = 0;
    prior.prior = {torch::randn({8}, torch::kFloat64), 7};
    ExpectGradient(*network, surface, code_, kind + ", surface");
    ExpectGradient(*network, handles, code_, kind + ", handles");
    ExpectGradient(*network, prior, code_, kind + ", prior");
  }
}

TEST_F(CodeEnergyTest, EnergyAndGradientAreTheSumsOverTheTerms) {
  const auto network = Network("hypernetwork");
  CodeEnergy all, surface, handles, more, prior;
  surface.all_points = all.all_points = AllPoints(*network);
  handles.sparse_points = {Handles(*network)};
  more.sparse_points = {Handles(*network)};
  all.sparse_points = {handles.sparse_points[0], more.sparse_points[0]};
  prior.prior = all.prior = {torch::randn({8}, torch::kFloat64), 7};
  surface.prior.weight = handles.prior.weight = more.prior.weight = 0;
  const CodeEnergyValue sum = CodeObjective(*network, all).At(code_);
  const torch::Tensor rows = torch::arange(20);
  Eigen::MatrixXd hessian = CodeObjective(*network, all).HalfHessian(code_, rows);
  double energy = 0;
  torch::Tensor gradient = torch::zeros({8}, torch::kFloat64);
  for (const CodeEnergy* part : {&surface, &handles, &more, &prior}) {
    const CodeObjective objective(*network, *part);
    const CodeEnergyValue value = objective.At(code_);
    energy += value.energy;
    gradient += value.gradient;
    hessian -= objective.HalfHessian(code_, rows);
  }
  EXPECT_NEAR(sum.energy, energy, 1e-12 * energy);
  EXPECT_NEAR(sum.energy, sum.all_points + sum.sparse_points[0] + sum.sparse_points[1] + sum.prior, 1e-12 * energy);
  EXPECT_NEAR(sum.all_points, 300 * sum.mean_square, 1e-12 * energy);
  EXPECT_TRUE(torch::allclose(sum.gradient, gradient, 1e-9, 1e-9));
  EXPECT_LT(hessian.cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(CodeEnergyTest, SparsePointsThatAreAllPointsWithWeightOneAreTheAllPointsTerm) {
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    CodeEnergy surface, handles;
    surface.all_points = AllPoints(*network);
    handles.sparse_points = {{surface.all_points->points, surface.all_points->targets,
                              torch::ones({20}, torch::kFloat64), surface.all_points->weight}};
    const CodeObjective one(*network, surface), other(*network, handles);
    EXPECT_NEAR(one.At(code_).energy, other.At(code_).energy, 1e-12 * one.At(code_).energy) << kind;
    EXPECT_TRUE(torch::allclose(one.At(code_).gradient, other.At(code_).gradient, 1e-12, 1e-12)) << kind;
    const Eigen::MatrixXd matrix = one.HalfHessian(code_, torch::arange(20));
    EXPECT_LT((matrix - other.HalfHessian(code_, {})).cwiseAbs().maxCoeff(), 1e-9 * matrix.norm()) << kind;
  }
}

TEST_F(CodeEnergyTest, HandlesByHand) {
  // A linear model whose positions are zero whatever the code: squared distances are those of the targets.
  LinearDeformation network({.kind = "linear", .latent = 2}, testing::SpherePoints(4), {});
  network.Set(torch::zeros({12}), torch::zeros({2, 12}));
  const std::vector<int> vertices = {0, 2};
  CodeEnergy energy;
  energy.sparse_points = {{VertexPoints(network, vertices), torch::tensor({{1.0f, 2.0f, 2.0f}, {0.0f, 3.0f, 4.0f}}),
                           torch::tensor({2.0f, 1.0f}), 12}};
  energy.prior = {torch::tensor({3.0f, 4.0f}), 2};
  const CodeObjective objective(network, energy);
  const CodeEnergyValue value = objective.At(objective.Zero());
  EXPECT_NEAR(value.sparse_points[0], 12.0 / 6 * (2 * 9 + 25), 1e-4);
  EXPECT_NEAR(value.prior, 2.0 / 2 * 25, 1e-6);
  EXPECT_TRUE(torch::allclose(value.gradient, torch::tensor({-6.0f, -8.0f})));
  EXPECT_EQ(value.all_points, 0);
}

TEST_F(CodeEnergyTest, MovedTargetsAreThoseOfAnotherEnergy) {
  const auto network = Network("conditioning");
  CodeEnergy energy;
  energy.sparse_points = {Handles(*network)};
  CodeObjective objective(*network, energy);
  energy.sparse_points[0].targets = torch::randn({3, 3}, torch::kFloat64);
  objective.MoveTargets(0, energy.sparse_points[0].targets);
  EXPECT_EQ(objective.At(code_).energy, CodeObjective(*network, energy).At(code_).energy);
  testing::ExpectError([&] { objective.MoveTargets(1, torch::zeros({3, 3})); }, "term 1 of 1");
  testing::ExpectError([&] { objective.MoveTargets(0, torch::zeros({2, 3})); }, "has shape (2, 3)");
}

TEST_F(CodeEnergyTest, RefusesTermsThatMakeNoSense) {
  const auto network = Network("linear");
  const auto refuse = [&](const SparsePointsTerm& term, const std::string& message) {
    CodeEnergy energy;
    energy.sparse_points = {term};
    testing::ExpectError([&] { CodeObjective(*network, energy); }, message);
  };
  SparsePointsTerm term = Handles(*network);
  term.weights = torch::ones({2});
  refuse(term, "weights of sparse points has shape (2), expected (3)");
  term.weights = torch::tensor({1.0, -0.5, 1.0});
  refuse(term, "the least is -0.5, expected 0 or more");
  term = Handles(*network);
  term.targets = torch::full({3, 3}, std::numeric_limits<double>::infinity());
  refuse(term, "targets of sparse points: 9 of 9 numbers are not finite");
  term = Handles(*network);
  term.weight = -1;
  refuse(term, "weight of sparse points is -1");
  CodeEnergy prior;
  prior.prior.mean = torch::zeros({7});
  testing::ExpectError([&] { CodeObjective(*network, prior); }, "mean of the prior has shape (7), expected (8)");
  const std::vector<int> vertices = {20};
  testing::ExpectError([&] { VertexPoints(*network, vertices); }, "vertex 20 of a template of 20");
}

}  // namespace
}  // namespace daumier::deform
