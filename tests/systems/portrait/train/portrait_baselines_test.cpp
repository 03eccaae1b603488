#include "systems/portrait/train/portrait_baselines.h"

#include "tests/support/expect_error.h"
#include "tests/systems/portrait/train/small_portrait_runs.h"

namespace daumier::portrait {
namespace {

TEST(PortraitBaselines, FitsReadLandmarksOfAFolder) {
  const testing::TempDir folder;
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const FacePainter painter(model);
  Rng rng(8);
  const FacePicture face = painter.Paint(testing::DrawPortrait(model, rng));
  std::string text = "68\n";
  for (size_t n = 0; n < 68; ++n) text += fmt::format("{} {}\n", face.landmarks[2 * n], face.landmarks[2 * n + 1]);
  WriteFileAtomically(folder / "17.txt", text);
  const auto landmarks = LandmarksInFolder(folder.path(), "17");
  ASSERT_TRUE(landmarks);
  for (size_t k = 0; k < 136; ++k) EXPECT_NEAR((*landmarks)[k], face.landmarks[k], 1e-3);
  EXPECT_FALSE(LandmarksInFolder(folder.path(), "18"));
  const fitting::LandmarkModel landmark_model(model);
  const auto error = [&](fitting::PortraitFreedom freedom) {
    return LandmarkError(painter.Paint(FitCoefficients(landmark_model, *landmarks, freedom)).landmarks, *landmarks);
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
