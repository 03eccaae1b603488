#include "systems/deform/train/code_fit.h"

#include "systems/deform/train/array_deformations.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_deform.h"

#include <gtest/gtest.h>
#include <torch/linalg.h>

#include <algorithm>

namespace daumier::deform {
namespace {

class CodeFitTest : public ::testing::Test {
 protected:
  CodeFitTest() { torch::manual_seed(11), code_ = 0.15 * torch::randn({8}); }

  std::shared_ptr<DeformNetwork> Network(const std::string& kind) const {
    return testing::SmoothDeformNetwork(kind, template_);
  }
  torch::Tensor Surface(DeformNetwork& network, const torch::Tensor& code) const {
    const torch::NoGradGuard no_gradient;
    return network.DeformVertices(code.unsqueeze(0)).squeeze(0);
  }
  double Energy(DeformNetwork& network, const torch::Tensor& code, const torch::Tensor& targets) const {
    return options_.data_weight * (Surface(network, code) - targets).square().mean().item<double>() +
           options_.code_weight * code.square().mean().item<double>();
  }

  const torch::Tensor template_ = testing::SpherePoints(60);
  torch::Tensor code_;
  CodeFitOptions options_{.data_weight = 3e3, .code_weight = 1};
};

TEST_F(CodeFitTest, ExplainsASurfaceOfTheNetworkBetterThanItsOwnCode) {
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    const torch::Tensor targets = Surface(*network, code_);
    const CodeFit fit = FitCode(*network, targets, options_);
    EXPECT_LT(fit.energy, Energy(*network, code_, targets)) << kind;
    EXPECT_LT((fit.code - code_).norm().item<double>(), 0.1 * code_.norm().item<double>()) << kind;
    EXPECT_LE(fit.steps, options_.newton_steps) << kind;
  }
}

TEST_F(CodeFitTest, EnergyIsThatOfTheCodeAndBeginsAtZero) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_);
  for (const char* method : {"gauss_newton", "adam"}) {
    options_.method = method;
    options_.adam_steps = 3;
    const CodeFit fit = FitCode(*network, targets, options_);
    EXPECT_NEAR(fit.energies.front(), Energy(*network, torch::zeros({8}), targets), 1e-4 * fit.energies.front());
    EXPECT_NEAR(fit.energy, Energy(*network, fit.code, targets), 1e-4 * fit.energy);
    EXPECT_NEAR(fit.energy,
                options_.data_weight * fit.mean_square + options_.code_weight * fit.code.square().mean().item<double>(),
                1e-6 * fit.energy);
    EXPECT_EQ(int(fit.energies.size()), fit.steps + 1);
    EXPECT_GE(fit.seconds, 0);
  }
}

TEST_F(CodeFitTest, EnergiesOfGaussNewtonNeverRise) {
  options_.num_rows = 3;  // Too few to know the surface, so that some steps are bad.
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    const CodeFit fit = FitCode(*network, Surface(*network, 4 * code_) + 0.1 * template_, options_);
    EXPECT_TRUE(std::is_sorted(fit.energies.rbegin(), fit.energies.rend())) << kind;
    EXPECT_LT(fit.energy, fit.energies.front()) << kind;
  }
}

TEST_F(CodeFitTest, ALinearModelIsSolvedInOneStepAsByRidgeRegression) {
  LinearDeformation network({.kind = "linear", .latent = 4}, template_, {});
  const torch::Tensor mean = template_.flatten() * 1.1, rows = 0.3 * torch::randn({4, 180}),
                      targets = template_ + 0.2 * torch::randn({60, 3});
  network.Set(mean, rows);
  options_.code_weight = 50;
  const torch::Tensor r = rows.to(torch::kFloat64);
  const torch::Tensor matrix =
      options_.data_weight / 180 * torch::matmul(r, r.t()) + options_.code_weight / 4 * torch::eye(4, torch::kFloat64);
  const torch::Tensor ridge = torch::linalg_solve(
      matrix, options_.data_weight / 180 * torch::mv(r, targets.flatten().to(torch::kFloat64) - mean));
  const double least = Energy(network, ridge.to(torch::kFloat32), targets);
  const CodeFit fit = FitCode(network, targets, options_);
  EXPECT_NEAR(fit.energies[1], least, 1e-5 * least);
  EXPECT_LE(fit.steps, 2);
  EXPECT_LT((fit.code - ridge).abs().max().item<double>(), 1e-5);
  // A part of the points tells less of the matrix, but nothing else is minimised.
  options_.num_rows = 20;
  EXPECT_NEAR(FitCode(network, targets, options_).energy, least, 1e-4 * least);
}

TEST_F(CodeFitTest, BothMethodsFindTheSameMinimum) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_) + 0.02 * template_;
  const CodeFit ours = FitCode(*network, targets, options_);
  options_.method = "adam";
  options_.learning_rate = 1e-2;
  options_.adam_steps = 500;
  const CodeFit adam = FitCode(*network, targets, options_);
  EXPECT_NEAR(ours.energy, adam.energy, 1e-3 * adam.energy);
  EXPECT_LT((ours.code - adam.code).abs().max().item<double>(), 5e-3);
  EXPECT_LT(ours.steps, 20);
}

TEST_F(CodeFitTest, AdamKeepsTheBestCodeNotTheLast) {
  const auto network = Network("hypernetwork");
  options_.method = "adam";
  options_.learning_rate = 2;  // Far too long steps.
  options_.adam_steps = 10;
  const CodeFit fit = FitCode(*network, Surface(*network, code_), options_);
  EXPECT_EQ(fit.steps, 10);
  EXPECT_EQ(fit.energy, *std::min_element(fit.energies.begin(), fit.energies.end()));
  EXPECT_LT(fit.energy, fit.energies.back());
}

TEST_F(CodeFitTest, PointsBetweenVerticesAreFittedToo) {
  const auto network = Network("conditioning");
  const SurfacePoints points{torch::zeros({30, 3}, torch::kInt64), torch::full({30, 3}, 1.0 / 3),
                                     0.9 * testing::SpherePoints(30)};
  const torch::NoGradGuard no_gradient;
  const CodeFit fit = FitCode(*network, points, network->Deform(code_.unsqueeze(0), points).squeeze(0), options_);
  EXPECT_LT((fit.code - code_).norm().item<double>(), 0.1 * code_.norm().item<double>());
}

TEST_F(CodeFitTest, EqualOptionsGiveEqualCodes) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_);
  options_.num_rows = 20;
  EXPECT_TRUE(FitCode(*network, targets, options_).code.equal(FitCode(*network, targets, options_).code));
}

TEST_F(CodeFitTest, RefusesShapesThatDisagree) {
  const auto network = Network("linear");
  testing::ExpectError([&] { FitCode(*network, torch::zeros({59, 3})); }, "targets has shape (59, 3)");
  testing::ExpectError([&] { FitCode(*network, torch::zeros({60, 2})); }, "targets has shape (60, 2)");
  const SurfacePoints none = VerticesAsPoints(torch::zeros({0, 3}));
  testing::ExpectError([&] { FitCode(*network, none, torch::zeros({0, 3})); }, "no point");
}

}  // namespace
}  // namespace daumier::deform
