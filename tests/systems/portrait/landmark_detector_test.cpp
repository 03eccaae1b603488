#include "systems/portrait/landmark_detector.h"

#include "systems/portrait/landmark_errors.h"
#include "systems/portrait/landmark_views.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>

namespace daumier::portrait {
namespace {

constexpr LandmarkNetworkOptions kDetectorNetwork = {.resolution = 128, .deviation = 1.0};

/// 200 x 200, so that all places have their own colours.
render::Image Picture() {
  return testing::PictureOfPlaces(200, 200);
}

std::shared_ptr<testing::IdealLandmarkNetwork> NetworkOf(std::vector<std::vector<float>> faces) {
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = std::move(faces);
  return network;
}

std::vector<float> Turned(std::vector<float> points, double degrees) {
  const Eigen::Vector2d centre = BoxOf(points).centre();
  const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
  for (size_t i = 0; i < points.size(); i += 2) {
    const Eigen::Vector2d at = centre + turn * (Eigen::Vector2d(points[i], points[i + 1]) - centre);
    points[i] = float(at.x());
    points[i + 1] = float(at.y());
  }
  return points;
}

TEST(LandmarkDetector, FindsLandmarksWithinAQuarterOfAPixel) {
  const std::vector<float> truth = Turned(testing::PlausibleLandmarks(55, 40, 90), 12);
  const LandmarkDetector detector(kDetectorNetwork, NetworkOf({truth}), {.even_jaw = false});
  const DetectedFace face = detector.FindOne(Picture());
  for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(face.landmarks[i], truth[i], 0.25);
  EXPECT_GT(face.confidence, 0.9);
  EXPECT_GT(Overlap(face.box, BoxOf(truth)), 0.97);
  EXPECT_NEAR(face.frame.turn * 180 / std::numbers::pi, 12, 0.5);  // The last round is upright.
}

TEST(LandmarkDetector, TheMirroredRoundAgreesWithThePlainOne) {
  const std::vector<float> truth = testing::PlausibleLandmarks(50, 50, 100);
  auto network = NetworkOf({truth});
  network->right_eye_closed = true;
  const DetectedFace
      plain = LandmarkDetector(kDetectorNetwork, network, {.mirror = false, .even_jaw = false}).FindOne(Picture()),
      both = LandmarkDetector(kDetectorNetwork, network, {.mirror = true, .even_jaw = false}).FindOne(Picture());
  for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(plain.landmarks[i], both.landmarks[i], 0.1);
  EXPECT_GT(both.states[size_t(FaceState::kRightEyeClosed)], 0.9);
  EXPECT_LT(both.states[size_t(FaceState::kLeftEyeClosed)], 0.1);
}

TEST(LandmarkDetector, FindsSeveralFacesEachOnce) {
  const std::vector<float> left = testing::PlausibleLandmarks(15, 60, 70),
                           right = testing::PlausibleLandmarks(115, 50, 70);
  const LandmarkDetector detector(kDetectorNetwork, NetworkOf({left, right}));
  const std::vector<DetectedFace> faces = detector.FindAll(Picture());
  ASSERT_EQ(faces.size(), 2u);
  const bool first_is_left = faces[0].box.centre().x() < 100;
  EXPECT_GT(Overlap(faces[first_is_left ? 0 : 1].box, BoxOf(left)), 0.9);
  EXPECT_GT(Overlap(faces[first_is_left ? 1 : 0].box, BoxOf(right)), 0.9);
}

TEST(LandmarkDetector, RefusesAPictureWithoutAFaceWithTheConfidence) {
  testing::ExpectError([] { LandmarkDetector(kDetectorNetwork, NetworkOf({})).FindOne(Picture()); },
                       "no face found in the picture of 200 x 200 (the search has no candidate; a face needs 0.80)");
  auto doubtful = NetworkOf({testing::PlausibleLandmarks(50, 50, 100)});
  doubtful->is_face = -0.5;
  testing::ExpectError([&] { LandmarkDetector(kDetectorNetwork, doubtful).FindOne(Picture()); },
                       "the best candidate has a confidence of 0.2");
}

TEST(LandmarkDetector, SearchesSmallFacesInALargerPicture) {
  const std::vector<float> truth = testing::PlausibleLandmarks(150, 20, 24);
  const DetectedFace face = LandmarkDetector(kDetectorNetwork, NetworkOf({truth})).FindOne(Picture());
  EXPECT_GT(Overlap(face.box, BoxOf(truth)), 0.85);
}

TEST(LandmarkDetector, AcceptsTinyLongAndGreyPictures) {
  const LandmarkDetector detector(kDetectorNetwork, NetworkOf({}));
  for (const auto& [height, width, channels] : {std::array{1, 1, 3}, {2, 400, 3}, {900, 3, 1}, {40, 40, 1}})
    EXPECT_TRUE(detector.FindAll(render::Image(height, width, channels, 90)).empty());
  testing::ExpectError([&] { detector.FindAll(render::Image()); }, "expected at least one pixel");
}

TEST(LandmarkDetector, FindsAFaceInAPictureOfFewPixels) {
  const std::vector<float> truth = testing::PlausibleLandmarks(6, 5, 28);
  const DetectedFace face = LandmarkDetector(kDetectorNetwork, NetworkOf({truth}), {.even_jaw = false})
                                .FindOne(testing::PictureOfPlaces(40, 40));
  for (size_t i = 0; i < truth.size(); ++i) EXPECT_NEAR(face.landmarks[i], truth[i], 0.25);
}

TEST(LandmarkDetector, MayBeUsedFromSeveralThreads) {
  const std::vector<float> truth = testing::PlausibleLandmarks(50, 40, 90);
  const LandmarkDetector detector(kDetectorNetwork, NetworkOf({truth}));
  const render::Image picture = Picture();
  testing::ExpectTheSameFromThreads(1, [&] { return detector.FindOne(picture).landmarks; });
}

TEST(DetectedFace, MaskIsBackgroundOutsideOfTheCropAndEyeInTheEyes) {
  const std::vector<float> truth = testing::PlausibleLandmarks(60, 60, 80);
  const DetectedFace face = LandmarkDetector(kDetectorNetwork, NetworkOf({truth})).FindOne(Picture());
  const render::Image mask = face.Mask(200, 200);
  EXPECT_EQ(mask.at(2, 2), uint8_t(PictureClass::kBackground));
  EXPECT_EQ(mask.at(int(60 + 0.25 * 80), int(60 + 0.3 * 80)), uint8_t(PictureClass::kEyes));
  EXPECT_EQ(mask.at(int(60 + 0.5 * 80), int(60 + 0.5 * 80)), uint8_t(PictureClass::kSkin));
}

}  // namespace
}  // namespace daumier::portrait
