#include "systems/portrait/portrait_angles.h"

#include "fitting/portrait_fit.h"
#include "systems/portrait/portrait_crop.h"
#include "systems/portrait/portrait_picture.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_portraits.h"

#include <cmath>
#include <numbers>

namespace daumier::portrait {
namespace {

TEST(MovedAngles, OfAFaceAtTheFocalLengthsOffsetTurnByAnEighth) {
  const std::vector<float> ahead = {0, 0, 0};
  const auto from_the_right = MovedAngles(ahead, {1015, 0}, {0, 0}, 0);
  EXPECT_NEAR(from_the_right[0], 0, 1e-6);
  EXPECT_NEAR(from_the_right[1], std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(from_the_right[2], 0, 1e-6);
  const auto to_below = MovedAngles(ahead, {0, 0}, {0, 1015}, 0);
  EXPECT_NEAR(to_below[0], -std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(to_below[1], 0, 1e-6);
}

TEST(MovedAngles, InOnePlaceAreUnchanged) {
  const std::vector<float> angles = {0.3F, 0.5F, -0.4F};
  const auto same = MovedAngles(angles, {30, 40}, {30, 40}, 0);
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(same[k], angles[k], 1e-6);
}

TEST(MovedAngles, RefuseFewerThanThree) {
  testing::ExpectError([] { MovedAngles(std::vector<float>(2), {0, 0}, {0, 0}, 0); }, "2 angles");
}

TEST(MovedAngles, UndoThemselvesAndRollWithThePicture) {
  const std::vector<float> angles = {0.1F, -0.4F, 0.2F};
  const Eigen::Vector2d from(20, -35), to(-4, 12);
  const auto there = MovedAngles(angles, from, to, 0.3), back = MovedAngles(there, to, from, -0.3);
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], angles[k], 1e-6);
  EXPECT_NEAR(MovedAngles(angles, {0, 0}, {0, 0}, 0.3)[2], 0.2 - 0.3, 1e-6);
}

TEST(MovedAngles, AreThoseOfAFaceFittedInTheCrop) {
  // The mean face away from the middle; its crop in the middle, turned. The pose that explains the crop's landmarks
  // best.
  const faces::MorphableModel model = testing::SyntheticMorphable();
  const fitting::LandmarkModel landmarks_of(model);
  const FacePainter painter(model);
  std::vector<float> x(faces::kNumCoefficients);
  const std::array<float, 6> pose = {0.1F, 0.3F, -0.1F, 3, 2, -40};
  std::copy(pose.begin(), pose.end(), x.begin() + faces::kPoseSlot.first);
  const std::vector<float> landmarks = painter.Paint(x).landmarks;
  PictureMap turn;
  turn.linear << std::cos(0.2), -std::sin(0.2), std::sin(0.2), std::cos(0.2);
  const PictureMap map = Compose(turn, CropOfLandmarks(landmarks, 0.56));
  const std::vector<float> in_crop = MapLandmarks(landmarks, map);
  const fitting::PicturePoints points =
      Eigen::Map<const Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>>(in_crop.data(), 68, 2).cast<double>();
  const auto fit = fitting::FitPortrait(landmarks_of, points, Eigen::VectorXd::Ones(68),
                                        {.freedom = fitting::PortraitFreedom::kPose});
  const auto moved = MovedAngles(pose, OffsetOf(landmarks, 224), OffsetOf(in_crop, 224), map.rotation());
  fitting::PortraitPose expected = fitting::PortraitPose::Zero();
  for (int k = 0; k < 3; ++k) expected[k] = moved[size_t(k)];
  EXPECT_LT(fitting::AngleBetween(fit.pose(), expected), 1.0);
}

TEST(OffsetOf, IsTheMeanFromTheMiddleOfThePicture) {
  std::vector<float> landmarks;
  for (int n = 0; n < 68; ++n) landmarks.insert(landmarks.end(), {n % 2 == 0 ? 0.0F : 20.0F, float(n)});
  EXPECT_TRUE(OffsetOf(landmarks, 100).isApprox(Eigen::Vector2d(10 - 50, 33.5 - 50)));
}

}  // namespace
}  // namespace daumier::portrait
