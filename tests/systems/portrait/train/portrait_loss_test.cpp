#include "systems/portrait/train/portrait_loss.h"

#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

using testing::LossProblem;
using testing::MakeLossProblem;

PortraitLossOptions EveryTerm() {
  PortraitLossOptions options;
  options.openings = 0.1;
  options.reflectance = 5;
  options.vertices = 2;
  options.coefficients = 0.1;
  options.angles = 3;
  return options;
}

TEST(PortraitLoss, OfTheTruthIsTheRegulariserAlone) {
  const LossProblem p = MakeLossProblem(torch::kFloat32);
  PortraitLossOptions options = EveryTerm();
  options.reflectance = 0;
  const train::LossTerms terms = PortraitLoss(p.model, options)(p.truth, p.batch);
  EXPECT_LT(terms.parts.at("landmark_loss").item<float>(), 1e-6);
  EXPECT_NEAR(terms.parts.at("photometric_loss").item<float>(), 1e-3, 2e-4);  // sqrt of the rounding.
  EXPECT_LT(terms.parts.at("opening_loss").item<float>(), 1e-4);
  EXPECT_LT(terms.parts.at("vertex_loss").item<float>(), 1e-8);
  EXPECT_LT(terms.parts.at("coefficient_loss").item<float>(), 1e-8);
  EXPECT_LT(terms.parts.at("angle_loss").item<float>(), 1e-8);
  EXPECT_NEAR(terms.total.item<float>(), 3e-4 * terms.parts.at("regulariser").item<float>() + 2e-3, 6e-4);
}

TEST(PortraitLoss, AddsTermsByTheirWeightsAndLeavesOthersOut) {
  const LossProblem p = MakeLossProblem(torch::kFloat32);
  const PortraitLossOptions options = EveryTerm();
  const train::LossTerms terms = PortraitLoss(p.model, options)(p.guess, p.batch);
  const auto part = [&](const char* name) { return terms.parts.at(name).item<double>(); };
  const double sum = 2e-3 * part("landmark_loss") + 2 * part("photometric_loss") + 3e-4 * part("regulariser") +
                     0.1 * part("opening_loss") + 5 * part("reflectance_loss") + 2 * part("vertex_loss") +
                     0.1 * part("coefficient_loss") + 3 * part("angle_loss");
  EXPECT_NEAR(terms.total.item<double>(), sum, 1e-4 * sum);
  PortraitLossOptions landmarks_alone;
  landmarks_alone.photometric = 0;
  landmarks_alone.regulariser = 0;
  const train::LossTerms one = PortraitLoss(p.model, landmarks_alone)(p.guess, p.batch);
  EXPECT_EQ(one.parts.size(), 1U);
  EXPECT_FALSE(PortraitLoss(p.model, landmarks_alone).reads_pictures());
}

TEST(PortraitLoss, GradientOfTheWholeEqualsCentralDifferences) {
  const LossProblem p = MakeLossProblem(torch::kFloat64);
  const PortraitLoss loss(p.model, EveryTerm(), torch::kFloat64);
  const torch::Tensor x = p.guess.clone().set_requires_grad(true);
  loss(x, p.batch).total.backward();
  const torch::Tensor gradient = x.grad();
  const torch::NoGradGuard no_grad;
  const auto at = [&](int64_t b, int64_t k, double by) {
    torch::Tensor moved = p.guess.clone();
    moved[b][k] += by;
    return loss(moved, p.batch).total.item<double>();
  };
  // The pixels that the face covers change in steps; small ones hardly ever cross one.
  constexpr double kStep = 1e-7;
  std::vector<int64_t> numbers = {0, 3, 11, 80, 81, 83, 86, 144, 145, 146, 224, 225, 226, 230, 232};
  for (int64_t k = faces::kPoseSlot.first; k < faces::kNumCoefficients; ++k) numbers.push_back(k);
  double largest = gradient.abs().max().item<double>();
  for (int64_t b = 0; b < 2; ++b)
    for (const int64_t k : numbers) {
      const double numeric = (at(b, k, kStep) - at(b, k, -kStep)) / (2 * kStep);
      EXPECT_NEAR(gradient[b][k].item<double>(), numeric, 1e-4 * largest) << b << " " << k;
    }
}

TEST(PortraitRenderer, AgreesWithThePainter) {
  const LossProblem p = MakeLossProblem(torch::kFloat32);
  const PortraitRenderer renderer(p.model);
  const models::RenderedPictures rendered =
      renderer.Render(p.truth, renderer.layer().Vertices(p.truth), renderer.layer().Albedo(p.truth), true);
  EXPECT_LT((rendered.pictures - p.batch.at("picture")).abs().max().item<float>(), 2e-3);
  EXPECT_LT((renderer.Landmarks(p.truth) - p.batch.at("landmarks")).abs().max().item<float>(), 1e-3);
}

}  // namespace
}  // namespace daumier::portrait
