#include "systems/sketch/session_pen.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::sketch {
namespace {

using testing::ExpectError;

CanvasPoints Shaken(int count) {
  CanvasPoints path;
  for (int i = 0; i < count; ++i) path.emplace_back(2.0 * i, 100 + (i % 2 == 0 ? 2 : -2));
  return path;
}

double LargestStepAside(const CanvasPoints& line) {
  double largest = 0;
  for (size_t i = 1; i + 1 < line.size(); ++i) largest = std::max(largest, std::abs(line[i].y() - line[i - 1].y()));
  return largest;
}

TEST(Stabilised, AStringOfNoLengthChangesNothing) {
  const CanvasPoints path = Shaken(20);
  EXPECT_EQ(Stabilised(path, 0), path);
}

TEST(Stabilised, AStraightPathByHand) {
  // The point follows ten pixels behind, until the pen is lifted.
  const CanvasPoints line = Stabilised({{0, 0}, {100, 0}}, 10);
  EXPECT_EQ(line.front(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(line.back(), Eigen::Vector2d(100, 0));
  EXPECT_NEAR(line[line.size() - 2].x(), 90, 1e-9);
  for (const Eigen::Vector2d& point : line) EXPECT_EQ(point.y(), 0);
}

TEST(Stabilised, TremorVanishes) {
  const CanvasPoints path = Shaken(60);
  EXPECT_GT(LargestStepAside(path), 3.9);
  EXPECT_LT(LargestStepAside(Stabilised(path, 20)), 0.3);
}

TEST(Stabilised, IsNeverFartherFromThePathThanTheString) {
  CanvasPoints path;
  for (int i = 0; i < 50; ++i) path.emplace_back(100 * std::cos(0.3 * i), 80 * std::sin(0.2 * i));
  for (const Eigen::Vector2d& point : Stabilised(path, 15)) EXPECT_LE(datasets::DistanceTo(path, point), 15 + 1e-9);
}

TEST(Stabilised, HardlyDependsOnTheSampling) {
  CanvasPoints coarse, fine;
  for (int i = 0; i <= 20; ++i) coarse.emplace_back(5.0 * i, 0), coarse.emplace_back(5.0 * i + 2.5, 0);
  for (int i = 0; i <= 205; ++i) fine.emplace_back(0.5 * i, 0);
  const CanvasPoints a = Stabilised(coarse, 12), b = Stabilised(fine, 12);
  for (const Eigen::Vector2d& point : a) EXPECT_LT(datasets::DistanceTo(b, point), 1.5);
}

TEST(Stabilised, RefusesWhatIsNoPathOrString) {
  ExpectError([] { Stabilised({}, 3); }, "no point");
  ExpectError([] { Stabilised({{0, NAN}}, 3); }, "not finite");
  ExpectError([] { Stabilised({{0, 0}}, -1); }, "a stabiliser of -1 pixels");
  ExpectError([] { Stabilised({{0, 0}}, NAN); }, "a stabiliser of nan pixels");
}

TEST(WithMirrorImage, ALineOfOneSideIsDrawnTwice) {
  const CanvasPoints line = {{10, 5}, {20, 8}};
  const std::vector<CanvasPoints> drawn = WithMirrorImage(line, 50, 3);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0], line);
  EXPECT_EQ(drawn[1], (CanvasPoints{{90, 5}, {80, 8}}));
  EXPECT_EQ(Mirrored(drawn[1], 50), line);
}

TEST(WithMirrorImage, LinesThatMeetTheAxisAreOne) {
  const std::vector<CanvasPoints> from_axis = WithMirrorImage({{49, 0}, {30, 10}}, 50, 3);
  ASSERT_EQ(from_axis.size(), 1u);
  EXPECT_EQ(from_axis[0], (CanvasPoints{{30, 10}, {49, 0}, {51, 0}, {70, 10}}));
  const std::vector<CanvasPoints> to_axis = WithMirrorImage({{30, 10}, {49, 0}}, 50, 3);
  ASSERT_EQ(to_axis.size(), 1u);
  EXPECT_EQ(to_axis[0], from_axis[0]);
  const std::vector<CanvasPoints> loop = WithMirrorImage({{50, 0}, {20, 10}, {50, 20}}, 50, 3);
  ASSERT_EQ(loop.size(), 1u);
  EXPECT_EQ(loop[0].front(), loop[0].back());
  EXPECT_EQ(loop[0].size(), 7u);
}

TEST(WithMirrorImage, ASymmetricLineIsDrawnOnce) {
  const CanvasPoints mouth = {{30, 50}, {50, 56}, {70, 50}};
  EXPECT_EQ(WithMirrorImage(mouth, 50, 3), std::vector<CanvasPoints>{mouth});
}

}  // namespace
}  // namespace daumier::sketch
