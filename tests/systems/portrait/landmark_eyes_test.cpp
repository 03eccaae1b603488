#include "systems/portrait/landmark_eyes.h"

#include "systems/portrait/landmark_detector.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace daumier::portrait {
namespace {

TEST(SnapEyes, MovesLandmarksOfEyesOntoTheBoundaryAndNoOthers) {
  const std::vector<float> truth = testing::PlausibleLandmarks(50, 50, 100);
  auto network = std::make_shared<testing::IdealLandmarkNetwork>();
  network->faces = {truth};
  const LandmarkDetector detector({}, network, {.even_jaw = false});
  const DetectedFace face = detector.FindOne(testing::PictureOfPlaces(200, 200));
  std::vector<float> moved = face.landmarks;
  for (size_t i = 72; i < 96; i += 2) moved[i] += 1.5f;
  const std::vector<float> snapped = SnapEyes(moved, face.labels, face.frame);
  for (size_t i = 0; i < 34; ++i) {
    const size_t at = i < 18 ? 2 * i : 2 * (i + 30);  // Jaw, a brow's beginning; mouth.
    EXPECT_EQ(snapped[at], moved[at]);
  }
  for (const size_t first : {36u, 42u}) {
    const Box box = BoxOf({truth.data() + 2 * first, 12});
    for (size_t i = first; i < first + 6; ++i) {
      const double u = (double(snapped[2 * i]) - box.centre().x()) / (0.5 * box.width()),
                   v = (double(snapped[2 * i + 1]) - box.centre().y()) / (0.5 * box.height());
      EXPECT_NEAR(std::hypot(u, v), 1, 0.15);  // On the ellipse.
    }
  }
}

TEST(SnapEyes, LeavesLandmarksWhereNoEyeIsParsed) {
  const CropFrame frame{.centre = {100, 100}, .side = 128};
  std::vector<float> labels(8 * 64 * 64, 0);
  std::fill(labels.begin() + 64 * 64, labels.begin() + 2 * 64 * 64, 5.0f);  // All skin.
  const std::vector<float> points = testing::PlausibleLandmarks(50, 50, 100);
  EXPECT_EQ(SnapEyes(points, labels, frame), points);
}

}  // namespace
}  // namespace daumier::portrait
