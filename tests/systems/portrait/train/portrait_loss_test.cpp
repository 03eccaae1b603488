#include "systems/portrait/train/portrait_loss.h"

#include <gtest/gtest.h>
#include <torch/utils.h>
#include "systems/portrait/train/portrait_refinement.h"
#include "tests/support/gradcheck.h"
#include "tests/support/small_portraits.h"

namespace daumier::portrait {
namespace {

torch::Tensor AsTensor(const std::vector<float>& numbers, std::vector<int64_t> shape) {
  return torch::tensor(numbers).view(shape);
}

/// Batches of faces drawn by the model itself, in `type`.
struct LossProblem {
  faces::MorphableModel model = testing::SyntheticMorphable();
  torch::Tensor truth, guess;
  train::Batch batch;
};

LossProblem MakeLossProblem(torch::ScalarType type) {
  LossProblem problem;
  const FacePainter painter(problem.model);
  Rng rng(21);
  std::vector<torch::Tensor> truth, guess, landmarks, pictures, skin, vertices;
  for (int b = 0; b < 2; ++b) {
    const std::vector<float> x = testing::DrawPortrait(problem.model, rng);
    std::vector<float> y = x;
    const std::vector<float> other = testing::DrawPortrait(problem.model, rng);
    for (size_t k = 0; k < y.size(); ++k) y[k] += 0.15F * (other[k] - x[k]);
    const FacePicture face = painter.Paint(x);
    truth.push_back(AsTensor(x, {1, faces::kNumCoefficients}));
    guess.push_back(AsTensor(y, {1, faces::kNumCoefficients}));
    landmarks.push_back(AsTensor(face.landmarks, {1, 68, 2}));
    const torch::Tensor rgba = AsTensor(face.colours, {1, 224, 224, 4}).permute({0, 3, 1, 2});
    pictures.push_back(rgba.narrow(1, 0, 3));
    skin.push_back((rgba.narrow(1, 3, 1) > 0.999).to(torch::kFloat32));
    const geometry::Points points = faces::Reconstruct(problem.model, x).vertices;
    vertices.push_back(AsTensor({points.data(), points.data() + points.size()}, {1, points.rows(), 3}));
  }
  problem.truth = torch::cat(truth).to(type);
  problem.guess = torch::cat(guess).to(type);
  problem.batch.tensors = {{"landmarks", torch::cat(landmarks)},
                           {"landmark_weights", torch::ones({2, 68})},
                           {"picture", torch::cat(pictures).contiguous()},
                           {"skin", torch::cat(skin).contiguous()},
                           {"vertices", torch::cat(vertices)},
                           {"known", torch::tensor({1.F, 0.F})},
                           {"expression", problem.truth.slice(1, 80, 144)},
                           {"albedo", problem.truth.slice(1, 144, 224)},
                           {"light", problem.truth.slice(1, 224, 233)},
                           {"angles", problem.truth.slice(1, 233, 236)}};
  for (auto& [name, tensor] : problem.batch.tensors) tensor = tensor.to(type).contiguous();
  return problem;
}

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

TEST(RefinePortrait, LowersTheLossAndKeepsExpressionsInRange) {
  const LossProblem p = MakeLossProblem(torch::kFloat32);
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

}  // namespace
}  // namespace daumier::portrait
