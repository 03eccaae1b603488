#include "geometry/coordinates.h"

#include <gtest/gtest.h>

#include <vector>

namespace daumier::geometry {
namespace {

TEST(PointsFrom, TakesThreeNumbersAVertex) {
  const Points points = PointsFrom(std::vector<float>{1, 2, 3, 0.5f, -1, 4});
  EXPECT_EQ(points, (Points(2, 3) << 1, 2, 3, 0.5, -1, 4).finished());
  EXPECT_EQ(PointsFrom({}).rows(), 0);
}

}  // namespace
}  // namespace daumier::geometry
