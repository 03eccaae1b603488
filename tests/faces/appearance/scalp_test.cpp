#include "faces/appearance/scalp.h"

#include "tests/faces/appearance/soup_checks.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(Scalp, GridFollowsTheFaceAndLiesOnItsSkull) {
  const FaceTemplate face = testing::SyntheticFace();
  const Scalp scalp(face);
  const SkullGrid grid = scalp.GridOf(face.neutral);
  EXPECT_NEAR(grid.At(48, 90).y(), 11, 0.7) << "the crown of the ellipsoid";
  EXPECT_NEAR(grid.At(0, 20).x(), 0, 1e-6) << "the back";
  EXPECT_LT(grid.At(0, 20).z(), -6);
  EXPECT_GT(grid.Outwards(48, 20).z(), 0.7) << "the front";
  EXPECT_GT(grid.Outwards(72, 30).x(), 0.5) << "the own left";
  const SkullGrid scaled = scalp.GridOf(2 * face.neutral);
  EXPECT_LT((scaled.At(30, 47) - 2 * grid.At(30, 47)).norm(), 1e-9);
  EXPECT_NEAR(scaled.radius(), 2 * grid.radius(), 1e-9);
}

TEST(Scalp, HairlineRunsFromTheForeheadAroundTheEarsToTheNape) {
  const FaceTemplate face = testing::SyntheticFace();
  const Scalp scalp(face);
  const ScalpLines& lines = scalp.lines();
  EXPECT_EQ(HairlineAt(lines, 0, 0), lines.hairline);
  EXPECT_GT(HairlineAt(lines, 0, 1), lines.hairline) << "receding";
  EXPECT_EQ(HairlineAt(lines, 33, 0.5), HairlineAt(lines, -33, 0.5));
  EXPECT_GT(HairlineAt(lines, 0.4 * lines.ear_front + 0.6 * lines.ear_back, 0), lines.ear_top);
  EXPECT_LT(HairlineAt(lines, 180, 0), lines.ear_bottom);
  EXPECT_EQ(scalp.weights()[face.num_vertices() - 1], 1) << "the crown";
  EXPECT_EQ(scalp.weights()[face.annotation.landmarks[30]], 0) << "the nose";
  EXPECT_EQ(SmoothBetween(1, 3, 2), 0.5);
}

}  // namespace
}  // namespace daumier::faces
