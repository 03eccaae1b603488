#include "fitting/opening_moves.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

size_t IndexOf(const OpeningMover& mover, Opening opening) {
  for (size_t i = 0; i < mover.openings().size(); ++i) {
    if (mover.openings()[i].opening == opening) return i;
  }
  ADD_FAILURE();
  return 0;
}

TEST(OpeningMover, ClosesMouthAndEyes) {
  const auto face = testing::SyntheticFace();
  const OpeningMover mover(face, FindOpeningPairs(face), 3, 3);
  for (const auto opening : {Opening::kMouth, Opening::kRightEye, Opening::kLeftEye}) {
    const size_t i = IndexOf(mover, opening);
    geometry::Points points = face.neutral;
    EXPECT_GT(GapsOf(mover.openings()[i], points).maxCoeff(), 0.3);
    mover.Reach({.closed = true}, i, points);
    const Eigen::VectorXd gaps = GapsOf(mover.openings()[i], points);
    EXPECT_LT(gaps.maxCoeff(), 0.062);
    EXPECT_GT(gaps.minCoeff(), -0.012);
  }
}

TEST(OpeningMover, MovesTheUpperLidAlone) {
  const auto face = testing::SyntheticFace();
  const OpeningMover mover(face, FindOpeningPairs(face));
  const size_t eye = IndexOf(mover, Opening::kLeftEye);
  geometry::Points points = face.neutral;
  mover.Reach({.closed = true}, eye, points);
  for (const int vertex : mover.openings()[eye].lower)
    EXPECT_TRUE(points.row(vertex).isApprox(face.neutral.row(vertex)));
  EXPECT_TRUE(points.row(face.annotation.landmarks[8]).isApprox(face.neutral.row(face.annotation.landmarks[8])));
}

TEST(OpeningMover, UncrossesLips) {
  const auto face = testing::SyntheticFace();
  const OpeningMover mover(face, FindOpeningPairs(face));
  const size_t mouth = IndexOf(mover, Opening::kMouth);
  geometry::Points points = face.neutral;
  for (const int vertex : mover.openings()[mouth].upper) points(vertex, 1) -= 1.2;
  points.row(mover.openings()[mouth].upper.front()) = face.neutral.row(mover.openings()[mouth].upper.front());
  points.row(mover.openings()[mouth].upper.back()) = face.neutral.row(mover.openings()[mouth].upper.back());
  ASSERT_LT(GapsOf(mover.openings()[mouth], points).minCoeff(), -0.1);
  mover.Reach({}, mouth, points);
  EXPECT_GT(GapsOf(mover.openings()[mouth], points).minCoeff(), -0.012);
}

TEST(OpeningMover, OpensAtLeastAsFarAsAskedAndLeavesAWiderMouth) {
  const auto face = testing::SyntheticFace();
  const OpeningMover mover(face, FindOpeningPairs(face));
  const size_t mouth = IndexOf(mover, Opening::kMouth);
  geometry::Points points = face.neutral;
  const double gap = GapsOf(mover.openings()[mouth], points).maxCoeff();
  mover.Reach({.least_middle_cm = gap / 8}, mouth, points);
  EXPECT_TRUE(points.isApprox(face.neutral));
  mover.Reach({.least_middle_cm = 2 * gap}, mouth, points);
  EXPECT_NEAR(GapsOf(mover.openings()[mouth], points).maxCoeff(), 2 * gap, 0.2 * gap);
}

TEST(OpeningMover, RefusesAReachOfNothing) {
  const auto face = testing::SyntheticFace();
  testing::ExpectError([&] { OpeningMover(face, FindOpeningPairs(face), 0, 1); }, "follows lips over 0 cm");
}

}  // namespace
}  // namespace daumier::fitting
