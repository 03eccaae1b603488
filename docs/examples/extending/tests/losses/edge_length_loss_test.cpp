#include "losses/edge_length_loss.h"

#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

#include <torch/utils.h>

namespace daumier::losses {
namespace {

TEST(EdgeLengthLoss, OfTwoEdgesWorkedOutByHand) {
  // Lengths 5 and 2 for 3 and 2: ((5 - 3)^2 + 0^2) / 2. The second face is not known.
  const auto x = torch::tensor({{{0., 0., 0.}, {3., 4., 0.}, {0., 0., 2.}}}, torch::kFloat64),
             y = torch::tensor({{{0., 0., 0.}, {3., 0., 0.}, {0., 2., 0.}}}, torch::kFloat64);
  const auto edges = torch::tensor({{0, 1}, {0, 2}}, torch::kInt64), known = torch::tensor({1., 0.}, torch::kFloat64);
  EXPECT_DOUBLE_EQ(EdgeLengthLoss(torch::cat({x, x}), torch::cat({y, 9 * y}), edges, known).item<double>(), 2);
}

TEST(EdgeLengthLoss, GradientEqualsCentralDifferences) {
  torch::manual_seed(1);
  const auto x = torch::randn({2, 5, 3}, torch::kFloat64), y = torch::randn({2, 5, 3}, torch::kFloat64);
  const auto edges = EdgesOf(torch::tensor({{0, 1, 2}, {2, 3, 4}}, torch::kInt64)),
             known = torch::ones({2}, torch::kFloat64);
  EXPECT_LT(testing::MaxGradientError([&](const auto& at) { return EdgeLengthLoss(at, y, edges, known); }, x), 1e-8);
}

TEST(EdgeLengthLoss, IsBlindToRotationAndTranslation) {
  torch::manual_seed(2);
  const auto x = torch::randn({1, 4, 3}, torch::kFloat64),
             quarter_turn = torch::tensor({{0., 1., 0.}, {-1., 0., 0.}, {0., 0., 1.}}, torch::kFloat64);
  const auto edges = EdgesOf(torch::tensor({{0, 1, 2}, {1, 2, 3}}, torch::kInt64)),
             known = torch::ones({1}, torch::kFloat64);
  EXPECT_LT(EdgeLengthLoss(torch::matmul(x, quarter_turn) + 7, x, edges, known).item<double>(), 1e-24);
}

TEST(EdgesOf, TwoTrianglesShareOneEdge) {
  const auto edges = EdgesOf(torch::tensor({{0, 1, 2}, {3, 2, 1}}, torch::kInt64));
  EXPECT_TRUE(torch::equal(edges, torch::tensor({{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}, torch::kInt64)));
}

TEST(EdgeLengthLoss, RefusesShapesThatDisagree) {
  const auto x = torch::zeros({2, 5, 3}), edges = torch::zeros({4, 2}, torch::kInt64);
  testing::ExpectError(
      [&] {
        EdgeLengthLoss(x, torch::zeros({2, 4, 3}), edges, torch::ones({2}));
      },
      "target has shape");
  testing::ExpectError([&] { EdgeLengthLoss(x, x, edges, torch::ones({3})); }, "known has shape");
}

}  // namespace
}  // namespace daumier::losses
