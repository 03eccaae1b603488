#include "losses/box_loss.h"
#include "losses/heat_map_loss.h"
#include "losses/label_loss.h"
#include "losses/state_loss.h"
#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

namespace daumier::losses {
namespace {

const auto kDouble = torch::kFloat64;

TEST(HeatMapLoss, IsZeroIffTheSoftmaxIsThePointsDistribution) {
  const torch::Tensor points = torch::tensor({{{2.3, 4.1}, {5.5, 0.7}}}, kDouble), weights = torch::ones({1, 2}, kDouble);
  const torch::Tensor ideal = PointDistributions(points, 6, 8, 1.1).log() + 3;  // Any constant.
  EXPECT_NEAR(HeatMapLoss(ideal, points, weights, 1.1).item<double>(), 0, 1e-12);
  torch::Tensor other = ideal.clone();
  other[0][1][0][0] += 5;
  EXPECT_GT(HeatMapLoss(other, points, weights, 1.1).item<double>(), 1e-4);
  EXPECT_NEAR(HeatMapLoss(other, points, torch::tensor({{1., 0.}}, kDouble), 1.1).item<double>(), 0, 1e-12);
}

TEST(HeatMapLoss, OfAFlatMapIsTheLogarithmOfItsCellsLessTheEntropy) {
  const torch::Tensor points = torch::tensor({{{8.0, 8.0}}}, kDouble);
  const double loss =
      HeatMapLoss(torch::zeros({1, 1, 16, 16}, kDouble), points, torch::ones({1, 1}, kDouble), 1.5).item<double>();
  EXPECT_NEAR(loss, std::log(256.0) - std::log(2 * M_PI * std::exp(1.0) * 2.25), 1e-3);
}

TEST(HeatMapLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(2);
  const torch::Tensor points = 5 * torch::rand({2, 3, 2}, kDouble), weights = torch::rand({2, 3}, kDouble),
                      maps = torch::randn({2, 3, 5, 4}, kDouble);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return HeatMapLoss(x, points, weights, 0.9); }, maps), 1e-8);
}

TEST(HeatMapLoss, PointsOfAnyValueAreFinite) {
  const torch::Tensor points = torch::tensor({{{-1e4, 3.0}}}, kDouble);
  EXPECT_TRUE(PointDistributions(points, 4, 4, 1).isfinite().all().item<bool>());
}

TEST(HeatMapLoss, RefusesShapesThatDisagree) {
  const torch::Tensor maps = torch::zeros({2, 3, 4, 4}), points = torch::zeros({2, 3, 2}), weights = torch::zeros({2, 3});
  testing::ExpectError([&] { HeatMapLoss(maps, points.slice(1, 1), weights, 1); }, "points has shape");
  testing::ExpectError([&] { HeatMapLoss(maps, points, weights.slice(0, 1), 1); }, "weights has shape");
  testing::ExpectError([&] { HeatMapLoss(maps, points, weights, 0); }, "expected a positive number");
}

TEST(LabelLoss, OfTwoPixelsWorkedOutByHand) {
  // Classes of probability 3/4 and 1/2; weights 2 and 1; a third pixel does not count.
  const torch::Tensor scores = torch::tensor({{{{0., 0., 9.}}, {{std::log(3.), 0., 1.}}}}, kDouble);
  const torch::Tensor labels = torch::tensor({{{int64_t{1}, int64_t{0}, kNoLabel}}}), weights = torch::tensor({1., 2.}, kDouble);
  EXPECT_NEAR(LabelLoss(scores, labels, weights).item<double>(), (2 * std::log(4. / 3) + std::log(2.)) / 3, 1e-12);
  EXPECT_EQ(LabelLoss(scores, torch::full({1, 1, 3}, kNoLabel, torch::kInt64), weights).item<double>(), 0);
}

TEST(LabelLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(2);
  const torch::Tensor labels = torch::randint(0, 3, {2, 4, 5}, torch::kInt64), weights = torch::rand({3}, kDouble);
  labels[0][0][0] = kNoLabel;
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return LabelLoss(x, labels, weights); },
                                      torch::randn({2, 3, 4, 5}, kDouble)),
            1e-8);
}

TEST(StateLoss, IsTheMeanOfTheKnownStates) {
  const torch::Tensor scores = torch::tensor({{0., std::log(3.), 1., 1., 1.}, {5., 5., 0., 0., 0.}}, kDouble);
  const torch::Tensor classes = torch::tensor({{int64_t{1}, int64_t{2}}, {int64_t{0}, kNoLabel}});
  const torch::Tensor weights = torch::ones({2}, kDouble);
  EXPECT_NEAR(StateLoss(scores, {2, 3}, classes, weights).item<double>(),
              (std::log(4. / 3) + std::log(3.) + std::log(2.)) / 3, 1e-12);
  EXPECT_EQ(StateLoss(scores, {2, 3}, torch::full({2, 2}, kNoLabel, torch::kInt64), weights).item<double>(), 0);
}

TEST(StateLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(3);
  const torch::Tensor classes = torch::tensor({{int64_t{1}, int64_t{2}}, {kNoLabel, int64_t{0}}}), weights = torch::tensor({0.5, 2.}, kDouble);
  EXPECT_LT(testing::MaxGradientError([&](const auto& x) { return StateLoss(x, {2, 3}, classes, weights); },
                                      torch::randn({2, 5}, kDouble)),
            1e-8);
  testing::ExpectError([&] { StateLoss(torch::zeros({2, 4}), {2, 3}, classes, weights); }, "scores has shape (2, 4)");
}

BoxTargets OneBox() {
  BoxTargets targets{torch::zeros({1, 3, 3}, kDouble), torch::zeros({1, 4, 3, 3}, kDouble), torch::zeros({1, 3, 3}, kDouble)};
  targets.score[0][1][1] = 1;
  targets.score[0][1][2] = 0.5;
  targets.weight[0][1][1] = 1;
  targets.box[0][2][1][1] = 0.7;
  return targets;
}

TEST(BoxLoss, WorkedOutByHand) {
  const BoxLossTerms terms = BoxLoss(torch::zeros({1, 5, 3, 3}, kDouble), OneBox());
  const double entropy = std::log(2.0) / 4;  // Of p = 1/2 in each of the nine cells.
  EXPECT_NEAR(terms.score.item<double>(), entropy * (1 + 7 + 1.0 / 16), 1e-12);
  EXPECT_NEAR(terms.box.item<double>(), 0.7, 1e-12);
}

TEST(BoxLoss, GradientsEqualCentralDifferences) {
  torch::manual_seed(4);
  const BoxTargets targets = OneBox();
  EXPECT_LT(testing::MaxGradientError(
                [&](const auto& x) {
                  const BoxLossTerms terms = BoxLoss(x, targets);
                  return terms.score + terms.box;
                },
                torch::randn({1, 5, 3, 3}, kDouble)),
            1e-8);
}

TEST(BoxLoss, OfAPictureWithoutABoxIsThatOfItsScoresAlone) {
  const BoxTargets none{torch::zeros({1, 2, 2}), torch::zeros({1, 4, 2, 2}), torch::zeros({1, 2, 2})};
  const BoxLossTerms terms = BoxLoss(torch::full({1, 5, 2, 2}, -20.f), none);
  EXPECT_NEAR(terms.score.item<double>(), 0, 1e-6);
  EXPECT_EQ(terms.box.item<double>(), 0);
}

}  // namespace
}  // namespace daumier::losses
