#include "render/region_boundary.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::render {
namespace {

TEST(ZeroBoundary, OfADiscHasItsRadius) {
  constexpr int kSide = 40;
  std::vector<float> field;
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column)
      field.push_back(float(11 - std::hypot(column + 0.5 - 20.3, row + 0.5 - 18.7)));
  const std::vector<BoundaryPiece> pieces = ZeroBoundary(field, kSide, kSide);
  double length = 0;
  for (const BoundaryPiece& piece : pieces) {
    length += (piece.to - piece.from).norm();
    EXPECT_NEAR((piece.from - Eigen::Vector2d(20.3, 18.7)).norm(), 11, 0.02);
  }
  EXPECT_NEAR(length, 2 * M_PI * 11, 0.2);
}

TEST(ZeroBoundary, OfAFieldWithoutAChangeOfSignIsEmpty) {
  EXPECT_TRUE(ZeroBoundary(std::vector<float>(12, -1.0f), 3, 4).empty());
  testing::ExpectError([] { ZeroBoundary(std::vector<float>(11), 3, 4); }, "11 numbers is no 3 x 4");
}

TEST(ZeroBoundary, CutsASaddleAroundItsPositiveCorners) {
  const std::vector<float> field = {1, -1, -1, 1};
  const auto pieces = ZeroBoundary(field, 2, 2);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_FALSE(NearestOnBoundary(pieces, {1, 1}, 0.3).has_value());  // The middle is apart from both.
}

TEST(NearestOnBoundary, IsTheFootOfThePerpendicularWithinReach) {
  const std::vector<BoundaryPiece> pieces = {{{0, 0}, {4, 0}}, {{0, 9}, {4, 9}}};
  const auto nearest = NearestOnBoundary(pieces, {1, 2}, 3);
  ASSERT_TRUE(nearest.has_value());
  EXPECT_NEAR((*nearest - Eigen::Vector2d(1, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(NearestOnBoundary(pieces, {1, 4}, 3).has_value());
  EXPECT_FALSE(NearestOnBoundary({}, {1, 4}, 3).has_value());
}

}  // namespace
}  // namespace daumier::render
