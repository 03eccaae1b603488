#include "systems/portrait/train/portrait_refinement.h"

#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(RefinePortrait, LowersTheLossAndKeepsExpressionsInRange) {
  const testing::LossProblem p = testing::MakeLossProblem(torch::kFloat32);
  PortraitLossOptions options;
  options.regulariser = 0;
  const PortraitLoss loss(p.model, options);
  train::Batch one;
  for (const auto& [name, tensor] : p.batch.tensors) one.tensors[name] = tensor.slice(0, 0, 1).contiguous();
  const torch::Tensor guess = p.guess.slice(0, 0, 1);
  const torch::Tensor refined = RefinePortrait(loss, guess, one, faces::ExpressionWeights::kUnit, {.steps = 40});
  EXPECT_LT(loss(refined, one).total.item<float>(), 0.4 * loss(guess, one).total.item<float>());
  EXPECT_GE(refined.slice(1, 80, 144).min().item<float>(), 0);
  EXPECT_LE(refined.slice(1, 80, 144).max().item<float>(), 1);
  // From the truth there is nothing to gain: the first guess stays the best.
  EXPECT_TRUE(RefinePortrait(loss, p.truth.slice(0, 0, 1), one, faces::ExpressionWeights::kUnit, {.steps = 3})
                  .allclose(p.truth.slice(0, 0, 1), 1e-3, 2e-2));
}

TEST(RefinePortrait, WithoutStepsIsTheGuess) {
  const testing::LossProblem p = testing::MakeLossProblem(torch::kFloat32);
  PortraitLossOptions options;
  options.photometric = 0;
  const PortraitLoss loss(p.model, options);
  train::Batch one;
  for (const auto& [name, tensor] : p.batch.tensors) one.tensors[name] = tensor.slice(0, 0, 1).contiguous();
  const torch::Tensor guess = p.guess.slice(0, 0, 1);
  EXPECT_TRUE(RefinePortrait(loss, guess, one, faces::ExpressionWeights::kUnit, {.steps = 0}).equal(guess));
}

}  // namespace
}  // namespace daumier::portrait
