#include "systems/deform/train/code_fit.h"

#include "systems/deform/train/array_deformations.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_deform.h"

#include <gtest/gtest.h>
#include <torch/linalg.h>
#include <torch/utils.h>

#include <algorithm>
#include <limits>

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
    EXPECT_LE(fit.steps, options_.solve.newton_steps) << kind;
  }
}

TEST_F(CodeFitTest, EnergyIsThatOfTheCodeAndBeginsAtZero) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_);
  for (const char* method : {"gauss_newton", "adam"}) {
    options_.solve.method = method;
    options_.solve.adam_steps = 3;
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
  options_.solve.num_rows = 3;  // Too few to determine the surface, so that some steps are bad.
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
  // A part of the points approximates the matrix, but the minimised energy is the same.
  options_.solve.num_rows = 20;
  EXPECT_NEAR(FitCode(network, targets, options_).energy, least, 1e-4 * least);
}

TEST_F(CodeFitTest, BothMethodsFindTheSameMinimum) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_) + 0.02 * template_;
  const CodeFit ours = FitCode(*network, targets, options_);
  options_.solve.method = "adam";
  options_.solve.learning_rate = 1e-2;
  options_.solve.adam_steps = 500;
  const CodeFit adam = FitCode(*network, targets, options_);
  EXPECT_NEAR(ours.energy, adam.energy, 1e-3 * adam.energy);
  EXPECT_LT((ours.code - adam.code).abs().max().item<double>(), 5e-3);
  EXPECT_LT(ours.steps, 20);
}

TEST_F(CodeFitTest, AdamReportsItsStepsAndStopsBetweenThem) {
  const auto network = Network("positions");
  options_.solve.method = "adam";
  options_.solve.adam_steps = 4;
  std::stop_source stop;
  std::vector<int64_t> done;
  const Task task(stop.get_token(), [&](const TaskProgress& report) {
    EXPECT_EQ(report.total, 4);
    done.push_back(report.done);
    if (done.size() == 8) stop.request_stop();
  });
  FitCode(*network, network->template_vertices(), options_, task);
  EXPECT_EQ(done, (std::vector<int64_t>{0, 1, 2, 3, 4}));
  EXPECT_THROW(FitCode(*network, network->template_vertices(), options_, task), Cancelled);
  EXPECT_EQ(done.size(), 8u);
}

TEST_F(CodeFitTest, AdamKeepsTheBestCodeNotTheLast) {
  const auto network = Network("hypernetwork");
  options_.solve.method = "adam";
  options_.solve.learning_rate = 2;  // Far too long steps.
  options_.solve.adam_steps = 10;
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

TEST_F(CodeFitTest, HandlesAndASurfaceOfALinearModelAreSolvedAsByRidgeRegression) {
  LinearDeformation network({.kind = "linear", .latent = 4}, template_, {});
  network.Set(template_.flatten() * 1.1, 0.3 * torch::randn({4, 180}));
  network.to(torch::kFloat64);
  const torch::Tensor rows = network.named_buffers()["rows"], mean = network.named_buffers()["mean"];
  const auto real = torch::TensorOptions(torch::kFloat64);
  const std::vector<int> handles = {3, 40, 7};
  const std::vector<double> weights = {1, 0, 2.5};
  CodeEnergy energy;
  energy.all_points = {VerticesAsPoints(network.template_vertices()), template_ + 0.2 * torch::randn({60, 3}, real),
                       200};
  energy.sparse_points = {
      {VertexPoints(network, handles), torch::randn({3, 3}, real), torch::tensor(weights, real), 30}};
  energy.prior = {torch::randn({4}, real), 5};
  // Sum over the terms of c R W R^T z = sum of c R W (g - mean); R: a term's columns, c its weight over their number.
  torch::Tensor matrix = 5.0 / 4 * torch::eye(4, real) + 200.0 / 180 * torch::matmul(rows, rows.t());
  torch::Tensor right =
      5.0 / 4 * *energy.prior.mean + 200.0 / 180 * torch::mv(rows, energy.all_points->targets.flatten() - mean);
  for (size_t i = 0; i < handles.size(); ++i) {
    const torch::Tensor columns = rows.slice(1, 3 * handles[i], 3 * handles[i] + 3);
    const torch::Tensor wish = energy.sparse_points[0].targets[int64_t(i)] - mean.view({60, 3})[handles[i]];
    matrix = matrix + 30.0 / 9 * weights[i] * torch::matmul(columns, columns.t());
    right = right + 30.0 / 9 * weights[i] * torch::mv(columns, wish);
  }
  const CodeFit fit = FitCode(network, energy);
  EXPECT_LT((fit.code - torch::linalg_solve(matrix, right)).abs().max().item<double>(), 1e-7);
  EXPECT_LE(fit.steps, 2);
}

TEST_F(CodeFitTest, APriorAloneGivesItsMean) {
  const auto network = Network("hypernetwork");
  CodeEnergy energy;
  energy.prior = {code_, 10};
  const CodeFit fit = FitCode(*network, energy);
  EXPECT_LT((fit.code - code_).abs().max().item<double>(), 1e-6);
  EXPECT_NEAR(fit.energies.front(), 10 * code_.square().mean().item<double>(), 1e-5);
  EXPECT_NEAR(fit.energy, 0, 1e-9);
  energy.prior.mean.reset();
  EXPECT_TRUE(torch::equal(FitCode(*network, energy, {}).code, torch::zeros({8})));
}

TEST_F(CodeFitTest, WithoutAnyWeightTheStartIsTheResult) {
  const auto network = Network("hypernetwork");
  const std::vector<int> handles = {3, 40};
  CodeEnergy energy;
  energy.sparse_points = {{VertexPoints(*network, handles), torch::zeros({2, 3}), torch::zeros({2})}};
  energy.prior.weight = 0;
  const CodeFit fit = FitCode(*network, energy, {}, code_);
  EXPECT_TRUE(torch::equal(fit.code, code_));
  EXPECT_EQ(fit.steps, 0);
}

/// Handles at some vertices, where those of the surface of `code` are.
CodeEnergy HandlesAt(DeformNetwork& network, const torch::Tensor& surface, double weight) {
  const std::vector<int> handles = {3, 12, 25, 40, 58};
  std::vector<int64_t> rows(handles.begin(), handles.end());
  CodeEnergy energy;
  energy.sparse_points = {
      {VertexPoints(network, handles), surface.index_select(0, torch::tensor(rows)), torch::ones({5}), weight}};
  energy.prior.weight = 1;
  return energy;
}

TEST_F(CodeFitTest, HandlesAreReachedTheBetterTheHeavierTheyAre) {
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    const torch::Tensor surface = Surface(*network, code_);
    double last = std::numeric_limits<double>::infinity();
    for (const double weight : {1.0, 100.0, 1e4}) {
      const CodeEnergy energy = HandlesAt(*network, surface, weight);
      const CodeFit fit = FitCode(*network, energy, {}, 0.8 * code_);
      const double miss = CodeObjective(*network, energy).At(fit.code).sparse_points[0] / weight;
      EXPECT_LT(miss, last) << kind;
      last = miss;
    }
    EXPECT_LT(last, 1e-4) << kind;
  }
}

TEST_F(CodeFitTest, AStartAtTheSolutionStaysThere) {
  for (const std::string& kind : testing::DeformKinds()) {
    const auto network = Network(kind);
    CodeEnergy energy = HandlesAt(*network, Surface(*network, code_) + 0.02 * template_, 1e3);
    energy.all_points = {VerticesAsPoints(template_), Surface(*network, code_), 10};
    const CodeFit first = FitCode(*network, energy);
    const CodeFit second = FitCode(*network, energy, {}, first.code);
    EXPECT_NEAR(second.energies.front(), first.energy, 1e-9 * first.energy) << kind;
    EXPECT_LE(second.steps, 2) << kind;
    EXPECT_LE(second.steps, first.steps) << kind;
    EXPECT_LT((second.code - first.code).abs().max().item<double>(), 2e-3) << kind;
  }
}

TEST_F(CodeFitTest, MovedHandlesAreFollowedFromTheLastCodeWithItsMatrix) {
  for (const std::string& kind : testing::DeformKinds()) {
    SCOPED_TRACE(kind);
    const auto network = Network(kind);
    const torch::Tensor start = 0.8 * code_;
    CodeEnergy energy = HandlesAt(*network, Surface(*network, code_), 3e3);
    CodeFitter fitter(*network, energy, {}, start);
    const CodeFit first = fitter.Solve();
    EXPECT_TRUE(torch::equal(first.code, FitCode(*network, energy, {}, start).code));
    energy.sparse_points[0].targets = energy.sparse_points[0].targets + 2e-3;
    fitter.MoveTargets(0, energy.sparse_points[0].targets);
    const CodeFit warm = fitter.Solve(), cold = FitCode(*network, energy, {}, start);
    EXPECT_LT(warm.energy, (1 + 1e-3) * cold.energy);
    EXPECT_LT(warm.num_matrices, cold.num_matrices);
    EXPECT_LE(warm.steps, cold.steps);
    EXPECT_TRUE(torch::equal(fitter.code(), warm.code));
    EXPECT_TRUE(std::is_sorted(warm.energies.rbegin(), warm.energies.rend()));
    // The others have kinks, across which the kept matrix is of no use.
    if (kind == "displacements" || kind == "positions") continue;
    EXPECT_EQ(warm.num_matrices, 0);
    EXPECT_LT(warm.steps, cold.steps);
  }
}

TEST_F(CodeFitTest, HandlesThatJumpAreFollowedWithAnotherMatrix) {
  const auto network = Network("conditioning");
  CodeEnergy energy = HandlesAt(*network, Surface(*network, code_), 3e3);
  CodeFitter fitter(*network, energy);
  fitter.Solve();
  energy = HandlesAt(*network, Surface(*network, -2 * code_), 3e3);
  fitter.MoveTargets(0, energy.sparse_points[0].targets);
  const CodeFit jumped = fitter.Solve();
  EXPECT_GT(jumped.num_matrices, 0);
  EXPECT_NEAR(jumped.energy, FitCode(*network, energy).energy, 1e-3 * jumped.energy);
  EXPECT_TRUE(std::is_sorted(jumped.energies.rbegin(), jumped.energies.rend()));
}

TEST_F(CodeFitTest, AdamGoesFromTheStartToo) {
  const auto network = Network("hypernetwork");
  const CodeEnergy energy = HandlesAt(*network, Surface(*network, code_), 3e3);
  const CodeSolveOptions adam{.method = "adam", .adam_steps = 1};
  const CodeFit fit = FitCode(*network, energy, adam, code_);
  EXPECT_DOUBLE_EQ(fit.energies.front(), CodeObjective(*network, energy).At(code_).energy);
  CodeFitter fitter(*network, energy, adam, code_);
  const CodeFit first = fitter.Solve();
  EXPECT_EQ(fitter.Solve().energies.front(), first.energy);
}

TEST_F(CodeFitTest, EqualOptionsGiveEqualCodes) {
  const auto network = Network("hypernetwork");
  const torch::Tensor targets = Surface(*network, code_);
  options_.solve.num_rows = 20;
  EXPECT_TRUE(FitCode(*network, targets, options_).code.equal(FitCode(*network, targets, options_).code));
}

TEST_F(CodeFitTest, RefusesShapesThatDisagree) {
  const auto network = Network("linear");
  testing::ExpectError([&] { FitCode(*network, torch::zeros({59, 3})); }, "targets has shape (59, 3)");
  testing::ExpectError([&] { FitCode(*network, torch::zeros({60, 2})); }, "targets has shape (60, 2)");
  const SurfacePoints none = VerticesAsPoints(torch::zeros({0, 3}));
  testing::ExpectError([&] { FitCode(*network, none, torch::zeros({0, 3})); }, "no point");
  testing::ExpectError([&] { FitCode(*network, CodeEnergy{}, {}, torch::zeros({7})); }, "start has shape (7)");
}

TEST_F(CodeFitTest, RefusesNumbersThatAreNotFinite) {
  const auto network = Network("linear");
  torch::Tensor targets = torch::zeros({60, 3});
  targets[7][1] = std::numeric_limits<float>::quiet_NaN();
  testing::ExpectError([&] { FitCode(*network, targets); }, "targets: 1 of 180 numbers are not finite");
  const torch::Tensor endless = torch::full({8}, std::numeric_limits<float>::infinity());
  testing::ExpectError([&] { FitCode(*network, CodeEnergy{}, {}, endless); }, "start has numbers that are not finite");
  LinearDeformation endless_network({.kind = "linear", .latent = 8}, template_, {});
  endless_network.Set(template_.flatten(), endless.unsqueeze(1).expand({8, 180}).contiguous());
  for (const char* method : {"gauss_newton", "adam"})
    testing::ExpectError([&] { FitCode(endless_network, template_, {.solve = {.method = method}}); },
                         "the energy of the code where a fit starts is not finite");
}

}  // namespace
}  // namespace daumier::deform
