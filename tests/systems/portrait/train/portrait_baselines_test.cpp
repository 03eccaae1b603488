#include "systems/portrait/train/portrait_baselines.h"

#include "systems/portrait/landmark_errors.h"
#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitBaselines, AFitOfTheFaceMissesTheLandmarksByLess) {
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  Rng rng(8);
  const std::vector<float> landmarks = painter.Paint(testing::DrawPortrait(model, rng)).landmarks;
  const fitting::LandmarkModel landmark_model(model);
  const auto error = [&](fitting::PortraitFreedom freedom) {
    return NormalisedError(painter.Paint(FitCoefficients(landmark_model, landmarks, freedom)).landmarks, landmarks);
  };
  EXPECT_LT(error(fitting::PortraitFreedom::kPoseAndFace), 0.5 * error(fitting::PortraitFreedom::kPose));
}

TEST(PortraitBaselines, FitAllFitsEachPortrait) {
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  std::vector<std::vector<float>> landmarks;
  for (size_t i = 0; i < 2; ++i) landmarks.push_back(painter.Paint(testing::TrueCoefficients()[i]).landmarks);
  const PortraitGuesses guesses = FitAll(model, landmarks, fitting::PortraitFreedom::kPose);
  ASSERT_EQ(guesses.coefficients.size(), 2U);
  EXPECT_GT(guesses.ms.value(), 0);
  const fitting::LandmarkModel landmark_model(model);
  for (size_t i = 0; i < 2; ++i) {
    const std::vector<float>& x = guesses.coefficients[i];
    EXPECT_EQ(x, FitCoefficients(landmark_model, landmarks[i], fitting::PortraitFreedom::kPose));
    // Only the pose is free.
    EXPECT_EQ(std::vector<float>(x.begin(), x.begin() + faces::kPoseSlot.first), std::vector<float>(233));
  }
  EXPECT_NE(guesses.coefficients[0], guesses.coefficients[1]);
}

TEST(PortraitBaselines, RefuseOtherNumbersOfLandmarks) {
  const fitting::LandmarkModel model(testing::SyntheticMorphable());
  testing::ExpectError([&] { FitCoefficients(model, std::vector<float>(10), fitting::PortraitFreedom::kPose); },
                       "10 numbers of landmarks, expected 136");
}

}  // namespace
}  // namespace daumier::portrait
