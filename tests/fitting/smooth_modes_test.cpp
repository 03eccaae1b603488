#include "fitting/smooth_modes.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

/// Pairs of positions and their mirror images.
geometry::Points MirroredPositions() {
  Rng rng(4);
  geometry::Points points(20, 3);
  for (Eigen::Index i = 0; i < 10; ++i) {
    points.row(2 * i) << -3 - rng.Normal(), 4 * rng.Normal(), rng.Normal();
    points.row(2 * i + 1) << -points(2 * i, 0), points(2 * i, 1), points(2 * i, 2);
  }
  return points;
}

geometry::Points EverySecond(const geometry::Points& points) {
  geometry::Points result(points.rows() / 2, 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) result.row(i) = points.row(2 * i);
  return result;
}

TEST(SmoothModes, HaveTheCovarianceOfTheProcessAtTheirCentres) {
  const geometry::Points positions = MirroredPositions();
  const SmoothModesOptions options{.length_cm = 2, .deviation_cm = 0.3, .asymmetry = 1, .least_share = 0};
  const SmoothModes modes = MakeSmoothModes(positions, EverySecond(positions), options);
  const Eigen::MatrixXf covariance = modes.rows.transpose() * modes.rows;
  for (Eigen::Index i = 0; i < positions.rows(); ++i) {
    for (Eigen::Index j = 0; j < positions.rows(); ++j) {
      const double expected = 0.09 * std::exp(-(positions.row(i) - positions.row(j)).squaredNorm() / 8);
      EXPECT_NEAR(covariance(2 * i, 2 * j), expected, 2e-3);
      EXPECT_NEAR(covariance(2 * i + 1, 2 * j + 1), expected, 2e-3);
      EXPECT_EQ(covariance(2 * i, 2 * j + 1), 0);
    }
  }
}

TEST(SmoothModes, WithoutAsymmetryAreTheirOwnMirrorImages) {
  const geometry::Points positions = MirroredPositions();
  const SmoothModes modes = MakeSmoothModes(positions, EverySecond(positions), {.asymmetry = 0});
  ASSERT_GT(modes.size(), 0);
  for (Eigen::Index i = 0; i < 20; i += 2) {
    EXPECT_TRUE(modes.rows.col(2 * i).isApprox(-modes.rows.col(2 * i + 2), 1e-4f));
    EXPECT_TRUE(modes.rows.col(2 * i + 1).isApprox(modes.rows.col(2 * i + 3), 1e-4f));
  }
}

TEST(SmoothModes, StartWithTheGreatest) {
  const geometry::Points positions = MirroredPositions(), centres = EverySecond(positions);
  const SmoothModes modes = MakeSmoothModes(positions, centres);
  EXPECT_LT(modes.rows.row(modes.size() - 1).norm(), modes.rows.row(0).norm());
}

TEST(SmoothModes, RefuseWhatHasNoMeaning) {
  testing::ExpectError([] { MakeSmoothModes(MirroredPositions(), geometry::Points(0, 3)); }, "need centres");
  testing::ExpectError([] { MakeSmoothModes(MirroredPositions(), MirroredPositions(), {.length_cm = 0}); },
                       "of length 0");
}

}  // namespace
}  // namespace daumier::fitting
