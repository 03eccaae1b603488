#include "render/line_reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

using Eigen::Vector2d;

TEST(ReducedLine, NoPointIsFartherThanTheTolerance) {
  std::vector<Vector2d> line;
  for (int i = 0; i <= 100; ++i) line.push_back({double(i), 10 * std::sin(i / 16.0)});
  const std::vector<int> kept = ReducedLine(line, 0.5);
  EXPECT_LT(kept.size(), 20u);
  EXPECT_EQ(kept.front(), 0);
  EXPECT_EQ(kept.back(), 100);
  for (size_t k = 1; k < kept.size(); ++k) {
    const Vector2d from = line[size_t(kept[k - 1])], along = line[size_t(kept[k])] - from;
    for (int i = kept[k - 1]; i <= kept[k]; ++i) {
      const Vector2d arm = line[size_t(i)] - from;
      EXPECT_LE(std::abs(arm.x() * along.y() - arm.y() * along.x()) / along.norm(), 0.5 + 1e-12);
    }
  }
}

TEST(ReducedLine, CornersStayAndStraightPiecesGo) {
  const std::vector<Vector2d> corner = {{0, 0}, {1, 1e-9}, {2, 0}, {2, 1}, {2, 2}};
  EXPECT_EQ(ReducedLine(corner, 0.1), (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(ReducedLine({{3, 3}}, 0.1), (std::vector<int>{0}));
  EXPECT_TRUE(ReducedLine({}, 0.1).empty());
}

TEST(ReducedLine, AClosedLineKeepsItsFarthestPoint) {
  EXPECT_EQ(ReducedLine({{0, 0}, {4, 0}, {4, 4}, {0, 0}}, 0.5), (std::vector<int>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace daumier::render
