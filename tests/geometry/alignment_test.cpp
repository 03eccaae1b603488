#include "geometry/alignment.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

const Similarity kKnown{2.5, Eigen::AngleAxisd(1.1, Vector3(1, 2, -1).normalized()).toRotationMatrix(), {3, -4, 5}};

TEST(AlignSimilarity, RecoversAKnownTransform) {
  const Points source = testing::Torus(3, 1, 7, 5).vertices;
  const Similarity found = AlignSimilarity(source, kKnown.Apply(source));
  EXPECT_NEAR(found.scale, kKnown.scale, 1e-12);
  EXPECT_LT((found.rotation - kKnown.rotation).norm(), 1e-12);
  EXPECT_LT((found.translation - kKnown.translation).norm(), 1e-11);
}

TEST(AlignSimilarity, IgnoresPointsOfWeightZero) {
  const Points source = testing::Torus(3, 1, 7, 5).vertices;
  Points target = kKnown.Apply(source);
  target.row(4) << 100, 100, 100;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(source.rows());
  weights[4] = 0;
  EXPECT_NEAR(AlignSimilarity(source, target, weights).scale, kKnown.scale, 1e-12);
}

TEST(AlignRobustly, HardlyMovesByPointsThatAreFarOff) {
  const Points source = testing::Torus(3, 1, 7, 5).vertices;
  Points target = kKnown.Apply(source);
  for (const int row : {4, 11, 20, 27}) target.row(row) << 30, -20, 10;
  const Similarity found = AlignRobustly(source, target);
  EXPECT_NEAR(found.scale, kKnown.scale, 0.01);
  EXPECT_LT((found.rotation - kKnown.rotation).norm(), 0.01);
  EXPECT_GT(std::abs(AlignSimilarity(source, target).scale - kKnown.scale), 0.1);
}

TEST(AlignRobustly, EqualsTheSimilarityOfExactPoints) {
  const Points source = testing::Torus(3, 1, 7, 5).vertices;
  const Similarity found = AlignRobustly(source, kKnown.Apply(source));
  EXPECT_NEAR(found.scale, kKnown.scale, 1e-12);
  EXPECT_LT((found.translation - kKnown.translation).norm(), 1e-11);
  ExpectError([&] { AlignRobustly(source, source.topRows(3)); }, "35 source points for 3 target points");
}

TEST(AlignSimilarity, NeverReflects) {
  const Points source = testing::Torus(3, 1, 7, 5).vertices;
  const Points mirrored = source * Eigen::Vector3d(-1, 1, 1).asDiagonal();
  EXPECT_NEAR(AlignSimilarity(source, mirrored).rotation.determinant(), 1, 1e-12);
}

TEST(AlignSimilarity, RefusesDegenerateInput) {
  const Points points = testing::FlatSheet(2).vertices;
  ExpectError([&] { AlignSimilarity(points, points.topRows(3)); }, "9 source points for 3 target points");
  ExpectError([&] { AlignSimilarity(points, points, Eigen::VectorXd::Zero(9)); }, "not all zero");
  ExpectError([&] { AlignSimilarity(points.topRows(3), points.topRows(3)); }, "one line");
  ExpectError([&] { AlignSimilarity(points, Points::Ones(9, 3)); }, "one point");
}

TEST(Similarity, InverseUndoesIt) {
  Similarity similarity;
  similarity.scale = 2.5;
  similarity.rotation = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  similarity.translation = {3, -1, 4};
  Points points(2, 3);
  points << 1, 2, 3, -4, 5, 0.5;
  EXPECT_LT((Inverse(similarity).Apply(similarity.Apply(points)) - points).norm(), 1e-12);
}

}  // namespace
}  // namespace daumier::geometry
