#include "datasets/build/landmark_pairs.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(LandmarkPairs, ThoseThatAreThereWithTheirWeights) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const geometry::TriangleMesh mesh{face.neutral, face.triangles};
  MeshLandmarks landmarks;
  for (size_t l = 0; l < landmarks.size(); ++l) landmarks[l] = 2 * face.neutral.row(face.annotation.landmarks[l]);
  landmarks[5].reset();
  const ShiftedNumbers shifted;
  const FitInput input{face, mesh, landmarks, shifted, 0.1};
  const LandmarkPairs pairs = PairsOf(input, landmarks, SameLandmark);
  ASSERT_EQ(pairs.landmarks.size(), 67u);
  EXPECT_EQ(pairs.landmarks[5], 6);
  EXPECT_EQ(pairs.weights[0], 0.1);
  EXPECT_EQ(pairs.weights[16], 1);
  EXPECT_NEAR(MisfitOf(pairs), 0, 1e-9);
  const LandmarkPairs others = PairsOf(input, landmarks, [](int l) { return 67 - l; });
  EXPECT_EQ(others.landmarks[61], 61);
  EXPECT_GT(MisfitOf(others), 0.3);
}

TEST(LandmarkPairs, TheSpreadIsTheRootOfTheMeanSquare) {
  const geometry::Points points = (geometry::Points(2, 3) << -1, 0, 0, 3, 0, 0).finished();
  EXPECT_DOUBLE_EQ(SpreadOf(points, Eigen::Vector2d(1, 1)), 2);
  EXPECT_DOUBLE_EQ(SpreadOf(points, Eigen::Vector2d(3, 1)), std::sqrt(3.0));  // About 0: (3 * 1 + 9) / 4.
}

}  // namespace
}  // namespace daumier::datasets
