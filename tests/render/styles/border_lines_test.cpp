#include "render/styles/picture_lines.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

TEST(BorderLines, FollowTheOutlineOfABall) {
  for (const int supersampling : {1, 2}) {
    int num_outline = 0;
    for (const LinePoint& point : BorderLines(daumier::testing::BallHead(64, supersampling))) {
      if (point.strength < 1) continue;
      ++num_outline;
      EXPECT_NEAR(std::hypot(point.x - 32, point.y - 32), 24, 0.6) << "9 of 24 cm of 64 pixels";
    }
    EXPECT_GT(num_outline, 100 * supersampling);
  }
}

}  // namespace
}  // namespace daumier::render
