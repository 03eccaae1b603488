#include "systems/portrait/landmark_bulges.h"

#include "tests/support/expect_error.h"
#include "tests/support/ideal_landmark_network.h"

#include <gtest/gtest.h>

namespace daumier::portrait {
namespace {

TEST(Bulges, AtTheCentreAreMovedByTheShiftAndNothingMovesBeyondTheRadius) {
  const Bulges bulges({{.centre = {40, 50}, .radius = 20, .zoom = -0.4, .shift = {3, -1}}});
  EXPECT_NEAR((bulges.SourceOf({40, 50}) - Eigen::Vector2d(43, 49)).norm(), 0, 1e-12);
  EXPECT_EQ(bulges.SourceOf({61, 50}), Eigen::Vector2d(61, 50));
}

TEST(Bulges, ANegativeZoomShowsThePartLarger) {
  const Bulges bulges({{.centre = {50, 50}, .radius = 30, .zoom = -0.4}});
  EXPECT_NEAR(bulges.SourceOf({51, 50}).x(), 50.6, 0.01);
  EXPECT_GT(bulges.PlaceOf({55, 50}).x(), 56);
}

TEST(Bulges, PlaceOfUndoesSourceOf) {
  Rng rng(3);
  const std::vector<float> landmarks = testing::PlausibleLandmarks(20, 25, 90);
  for (int i = 0; i < 60; ++i) {
    const Bulges bulges = DrawBulges(landmarks, 1, rng);
    for (size_t k = 0; k < 136; k += 2) {
      const Eigen::Vector2d q(landmarks[k], landmarks[k + 1]);
      EXPECT_NEAR((bulges.SourceOf(bulges.PlaceOf(q)) - q).norm(), 0, 0.01);
    }
  }
  testing::ExpectError([&] { DrawBulges(std::vector<float>(4), 1, rng); }, "68 landmarks");
}

TEST(Bulges, TheFieldIsTheMoveOfEachCellsCentre) {
  const Bulges bulges({{.centre = {16, 16}, .radius = 20, .zoom = 0.3, .shift = {1, 2}}});
  const std::vector<float> field = bulges.Field(32, 8);
  ASSERT_EQ(field.size(), 128u);
  const Eigen::Vector2d p(2.5 * 4, 5.5 * 4), moved = bulges.SourceOf(p) - p;
  EXPECT_FLOAT_EQ(field[5 * 8 + 2], float(moved.x()));
  EXPECT_FLOAT_EQ(field[64 + 5 * 8 + 2], float(moved.y()));
}

}  // namespace
}  // namespace daumier::portrait
