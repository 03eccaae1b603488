#include "datasets/build/portrait_pose.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

class DrawPoseTest : public ::testing::Test {
 protected:
  DrawPoseTest() {
    const faces::FaceTemplate face = testing::SyntheticFace();
    landmarks_ = face.neutral(face.annotation.landmarks, Eigen::all);
    landmarks_.rowwise() -= landmarks_.colwise().mean().eval();
  }
  geometry::Points landmarks_;
};

TEST_F(DrawPoseTest, LandmarksHaveTheDrawnSizeAndPlace) {
  const PoseOptions options;
  for (uint64_t seed = 0; seed < 200; ++seed) {
    Rng rng(seed);
    const auto pose = DrawPose(landmarks_, {}, options, rng);
    const geometry::Points pixels = render::Project(PortraitCamera({}, pose), landmarks_);
    const Eigen::Vector2d low = pixels.leftCols<2>().colwise().minCoeff(),
                          high = pixels.leftCols<2>().colwise().maxCoeff();
    const double size = (high - low).maxCoeff() / 224;
    EXPECT_GE(size, options.smallest * 0.98);
    EXPECT_LE(size, options.largest * 1.02);
    const Eigen::Vector2d centre = (low + high) / 2 / 224;
    EXPECT_NEAR(centre.x(), 0.5, options.shift + 0.005);
    EXPECT_NEAR(centre.y(), 0.55, options.shift + 0.005);
    EXPECT_GE(pose[5], kFarthestPose);
    EXPECT_LE(pose[5], kNearestPose);
  }
}

TEST_F(DrawPoseTest, AnglesStayWithinTheirLimitsAndMostFacesLookAhead) {
  const double degree = std::numbers::pi / 180;
  int num_frontal = 0, num_far = 0;
  for (uint64_t seed = 0; seed < 400; ++seed) {
    Rng rng(seed);
    const auto pose = DrawPose(landmarks_, {}, {}, rng);
    EXPECT_LE(std::abs(pose[0]), 25.01 * degree);
    EXPECT_LE(std::abs(pose[1]), 60.01 * degree);
    EXPECT_LE(std::abs(pose[2]), 15.01 * degree);
    num_frontal += std::abs(pose[1]) < 30 * degree;
    num_far += std::abs(pose[1]) > 45 * degree;
  }
  EXPECT_GT(num_frontal, 300);
  EXPECT_GT(num_far, 10);
}

}  // namespace
}  // namespace daumier::datasets
