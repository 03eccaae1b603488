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
  EXPECT_EQ(Stabilised({path}, 0).points, path);
}

TEST(Stabilised, AStraightPathByHand) {
  // The point follows ten pixels behind, until the pen is lifted.
  const CanvasPoints line = Stabilised({.points = {{0, 0}, {100, 0}}}, 10).points;
  EXPECT_EQ(line.front(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(line.back(), Eigen::Vector2d(100, 0));
  EXPECT_NEAR(line[line.size() - 2].x(), 90, 1e-9);
  for (const Eigen::Vector2d& point : line) EXPECT_EQ(point.y(), 0);
}

TEST(Stabilised, TremorVanishes) {
  const CanvasPoints path = Shaken(60);
  EXPECT_GT(LargestStepAside(path), 3.9);
  EXPECT_LT(LargestStepAside(Stabilised({path}, 20).points), 0.3);
}

TEST(Stabilised, IsNeverFartherFromThePathThanTheString) {
  CanvasPoints path;
  for (int i = 0; i < 50; ++i) path.emplace_back(100 * std::cos(0.3 * i), 80 * std::sin(0.2 * i));
  for (const Eigen::Vector2d& point : Stabilised({path}, 15).points)
    EXPECT_LE(datasets::DistanceTo(path, point), 15 + 1e-9);
}

TEST(Stabilised, HardlyDependsOnTheSampling) {
  CanvasPoints coarse, fine;
  for (int i = 0; i <= 20; ++i) coarse.emplace_back(5.0 * i, 0), coarse.emplace_back(5.0 * i + 2.5, 0);
  for (int i = 0; i <= 205; ++i) fine.emplace_back(0.5 * i, 0);
  const CanvasPoints a = Stabilised({coarse}, 12).points, b = Stabilised({fine}, 12).points;
  for (const Eigen::Vector2d& point : a) EXPECT_LT(datasets::DistanceTo(b, point), 1.5);
}

TEST(Stabilised, RefusesWhatIsNoPathOrString) {
  ExpectError([] { Stabilised(PenLine(), 3); }, "no point");
  ExpectError([] { Stabilised({.points = {{0, NAN}}}, 3); }, "not finite");
  ExpectError([] { Stabilised({.points = {{0, 0}}}, -1); }, "a stabiliser of -1 pixels");
  ExpectError([] { Stabilised({.points = {{0, 0}}}, NAN); }, "a stabiliser of nan pixels");
}

TEST(Stabilised, WidthsFollowThePen) {
  const PenLine line = Stabilised({{{0, 0}, {100, 0}}, {2, 4}}, 10);
  ASSERT_EQ(line.widths.size(), line.points.size());
  EXPECT_EQ(line.widths.front(), 2);
  EXPECT_EQ(line.widths.back(), 4);
  for (size_t i = 1; i + 1 < line.points.size(); ++i)
    EXPECT_NEAR(line.widths[i], 2 + 2 * (line.points[i].x() + 10) / 100, 1e-9) << "the pen is ten pixels ahead";
}

TEST(WithWeight, IsTheWeightTimesThePressure) {
  const CanvasPoints path = {{0, 0}, {1, 0}, {2, 0}};
  EXPECT_TRUE(WithWeight(path, {}).widths.empty());
  EXPECT_EQ(WithWeight(path, {.weight = 4}).widths, (std::vector<double>{4, 4, 4}));
  EXPECT_EQ(WithWeight(path, {.weight = 4, .pressure = {0, 0.5, 1}}).widths,
            (std::vector<double>{4 * kLeastPressure, 2, 4}));
  EXPECT_EQ(WithWeight(path, {.weight = 4}).points, path);
}

TEST(WithWeight, RefusesWhatIsNoWeight) {
  ExpectError([] { WithWeight({{0, 0}}, {.weight = -1}); }, "a weight of -1 pixels");
  ExpectError([] { WithWeight({{0, 0}}, {.weight = NAN}); }, "a weight of nan pixels");
  ExpectError([] { WithWeight({{0, 0}}, {.pressure = {1}}); }, "without a weight");
  ExpectError([] { WithWeight({{0, 0}}, {.weight = 1, .pressure = {1, 1}}); }, "the pressure at 2 points of 1");
  ExpectError([] { WithWeight({{0, 0}}, {.weight = 1, .pressure = {1.5}}); }, "a pressure of 1.5");
  ExpectError([] { WithWeight({{0, 0}}, {.weight = 1, .pressure = {NAN}}); }, "a pressure of nan");
}

TEST(WithMirrorImage, ALineOfOneSideIsDrawnTwice) {
  const PenLine line{{{10, 5}, {20, 8}}, {1, 2}};
  const std::vector<PenLine> drawn = WithMirrorImage(line, 50, 3);
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0].points, line.points);
  EXPECT_EQ(drawn[1].points, (CanvasPoints{{90, 5}, {80, 8}}));
  EXPECT_EQ(drawn[1].widths, line.widths);
  EXPECT_EQ(Mirrored(drawn[1].points, 50), line.points);
}

TEST(WithMirrorImage, LinesThatMeetTheAxisAreOne) {
  const std::vector<PenLine> from_axis = WithMirrorImage({{{49, 0}, {30, 10}}, {1, 2}}, 50, 3);
  ASSERT_EQ(from_axis.size(), 1u);
  EXPECT_EQ(from_axis[0].points, (CanvasPoints{{30, 10}, {49, 0}, {51, 0}, {70, 10}}));
  EXPECT_EQ(from_axis[0].widths, (std::vector<double>{2, 1, 1, 2}));
  const std::vector<PenLine> to_axis = WithMirrorImage({{{30, 10}, {49, 0}}, {2, 1}}, 50, 3);
  ASSERT_EQ(to_axis.size(), 1u);
  EXPECT_EQ(to_axis[0].points, from_axis[0].points);
  EXPECT_EQ(to_axis[0].widths, from_axis[0].widths);
  const std::vector<PenLine> loop = WithMirrorImage({{{50, 0}, {20, 10}, {50, 20}}, {1, 2, 3}}, 50, 3);
  ASSERT_EQ(loop.size(), 1u);
  EXPECT_EQ(loop[0].points.front(), loop[0].points.back());
  EXPECT_EQ(loop[0].points.size(), 7u);
  EXPECT_EQ(loop[0].widths, (std::vector<double>{1, 2, 3, 3, 2, 1, 1}));
}

TEST(WithMirrorImage, ASymmetricLineIsDrawnOnce) {
  const CanvasPoints mouth = {{30, 50}, {50, 56}, {70, 50}};
  const std::vector<PenLine> drawn = WithMirrorImage({mouth}, 50, 3);
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_EQ(drawn[0].points, mouth);
}

}  // namespace
}  // namespace daumier::sketch
