#include "render/svg_path.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace daumier::render {
namespace {

using Eigen::Vector2d;
using testing::ExpectError;

constexpr double kTolerance = 0.1;

void ExpectPoints(const SvgPolyline& polyline, const std::vector<Vector2d>& expected) {
  ASSERT_EQ(polyline.points.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    EXPECT_LT((polyline.points[i] - expected[i]).norm(), 1e-12) << i << ": " << polyline.points[i].transpose();
  }
}

double DistanceTo(const SvgPolyline& polyline, const Vector2d& point) {
  double nearest = 1e300;
  for (size_t i = 1; i < polyline.points.size(); ++i) {
    const Vector2d from = polyline.points[i - 1], along = polyline.points[i] - from;
    const double t = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point - from - t * along).norm());
  }
  return nearest;
}

SvgPolyline ParseOne(const std::string& data, double tolerance = kTolerance) {
  const auto polylines = ParseSvgPath(data, tolerance).polylines;
  EXPECT_EQ(polylines.size(), 1U) << data;
  return polylines.empty() ? SvgPolyline{} : polylines[0];
}

TEST(SvgPath, StraightSegmentsAreWorkedOutByHand) {
  ExpectPoints(ParseOne("M1 2 L 3 4 H5 V6"), {{1, 2}, {3, 4}, {5, 4}, {5, 6}});
  ExpectPoints(ParseOne("m1 2 l 3 4 h5 v6"), {{1, 2}, {4, 6}, {9, 6}, {9, 12}});
}

TEST(SvgPath, CommandsAreRepeatedImplicitly) {
  ExpectPoints(ParseOne("M0 0 1 2 3 4"), {{0, 0}, {1, 2}, {3, 4}});
  ExpectPoints(ParseOne("m1 1 1 2 3 4 h1 2"), {{1, 1}, {2, 3}, {5, 7}, {6, 7}, {8, 7}});
}

TEST(SvgPath, ReadsCompactNumbers) {
  ExpectPoints(ParseOne("M1-2.5.3-.4,+1e1 -2E-1"), {{1, -2.5}, {0.3, -0.4}, {10, -0.2}});
  ExpectPoints(ParseOne("\n M 1. 2\t,\r\n3 4 "), {{1, 2}, {3, 4}});
}

TEST(SvgPath, ClosedSubpathEndsWhereItBegins) {
  const auto polylines = ParseSvgPath("M1 1 L 3 1 3 3 z l 1 0 M9 9 h1 v1 H9 V9 Z", kTolerance).polylines;
  ASSERT_EQ(polylines.size(), 3U);
  ExpectPoints(polylines[0], {{1, 1}, {3, 1}, {3, 3}, {1, 1}});
  ExpectPoints(polylines[1], {{1, 1}, {2, 1}});
  ExpectPoints(polylines[2], {{9, 9}, {10, 9}, {10, 10}, {9, 10}, {9, 9}});
}

TEST(SvgPath, LoneMovetoIsLeftOutAndClosedOneIsADot) {
  EXPECT_TRUE(ParseSvgPath("M1 2", kTolerance).polylines.empty());
  EXPECT_TRUE(ParseSvgPath("  ", kTolerance).polylines.empty());
  ExpectPoints(ParseOne("M1 2Z"), {{1, 2}});
  ExpectPoints(ParseOne("M1 2h0"), {{1, 2}});
}

TEST(SvgPath, CubicKeepsToTheExactCurve) {
  for (const double tolerance : {1.0, 0.1, 0.001}) {
    const auto polyline = ParseOne("M0 0 C 100 0 -20 80 60 60", tolerance);
    double largest = 0.0;
    for (int i = 0; i <= 1000; ++i) {
      const double t = i / 1000.0, s = 1 - t;
      const Vector2d exact =
          3 * s * s * t * Vector2d(100, 0) + 3 * s * t * t * Vector2d(-20, 80) + t * t * t * Vector2d(60, 60);
      largest = std::max(largest, DistanceTo(polyline, exact));
    }
    EXPECT_LE(largest, tolerance);
    EXPECT_GT(largest, 0.05 * tolerance) << "far more chords than needed";
  }
}

TEST(SvgPath, QuadraticKeepsToTheExactCurve) {
  const auto polyline = ParseOne("M0 0 Q 50 100 100 0");
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0;
    EXPECT_LE(DistanceTo(polyline, {100 * t, 200 * t * (1 - t)}), kTolerance);
  }
}

TEST(SvgPath, SmoothCommandsReflectTheLastControlPoint) {
  const auto smooth_cubic = ParseOne("M0 0 C 10 0 20 10 20 20 S 10 40 0 40");
  ExpectPoints(smooth_cubic, ParseOne("M0 0 C 10 0 20 10 20 20 C 20 30 10 40 0 40").points);
  const auto smooth_quadratic = ParseOne("m0 0 q 10 20 20 0 t 20 0");
  ExpectPoints(smooth_quadratic, ParseOne("M0 0 Q 10 20 20 0 Q 30 -20 40 0").points);
  // After another command there is nothing to reflect.
  ExpectPoints(ParseOne("M0 0 L5 5 S 10 40 0 40"), ParseOne("M0 0 L5 5 C 5 5 10 40 0 40").points);
}

TEST(SvgPath, ArcOfACircleKeepsItsRadius) {
  // A quarter of the circle around (0, 0), y down: from (10, 0) with sweep 1 to (0, 10).
  const auto polyline = ParseOne("M10 0 A10 10 0 0 1 0 10");
  EXPECT_EQ(polyline.points.front(), Vector2d(10, 0));
  EXPECT_EQ(polyline.points.back(), Vector2d(0, 10));
  for (const auto& point : polyline.points) EXPECT_NEAR(point.norm(), 10.0, 1e-12);
  const double half = std::numbers::sqrt2 / 2 * 10;
  EXPECT_LE(DistanceTo(polyline, {half, half}), kTolerance);
}

TEST(SvgPath, FlagsChooseOneOfFourArcs) {
  // Circles of radius 5 through (0, 0) and (5, 5) have their centres at (5, 0) and (0, 5).
  const auto centre_distance = [](const std::string& flags, const Vector2d& centre) {
    double largest = 0.0;
    for (const auto& point : ParseOne("M0 0 a5 5 0 " + flags + " 5 5").points) {
      largest = std::max(largest, std::abs((point - centre).norm() - 5.0));
    }
    return largest;
  };
  EXPECT_LT(centre_distance("0 0", {5, 0}), 1e-12);
  EXPECT_LT(centre_distance("0 1", {0, 5}), 1e-12);
  EXPECT_LT(centre_distance("1 0", {0, 5}), 1e-12);
  EXPECT_LT(centre_distance("1 1", {5, 0}), 1e-12);
  const auto long_arc = ParseOne("M0 0 a5 5 0 11 5 5"), short_arc = ParseOne("M0 0 a5 5 0 00 5 5");
  EXPECT_GT(long_arc.points.size(), 2 * short_arc.points.size());
}

TEST(SvgPath, FlagsNeedNoSeparators) {
  ExpectPoints(ParseOne("M0 0a5 5 0 015 5"), ParseOne("M0 0 a 5 5 0 0 1 5 5").points);
  ExpectPoints(ParseOne("M0 0a5 5 0 01.5.5.5.5 0 101 1"),
               ParseOne("M0 0 a 5 5 0 0 1 0.5 0.5 a 0.5 0.5 0 1 0 1 1").points);
}

TEST(SvgPath, TooSmallRadiiAreMadeLarger) {
  // The end points are 20 apart: the smallest circle has its centre between them.
  for (const auto& point : ParseOne("M-10 0 A1 1 0 0 1 10 0").points) EXPECT_NEAR(point.norm(), 10.0, 1e-12);
  ExpectPoints(ParseOne("M0 0 A0 5 0 0 1 10 0"), {{0, 0}, {10, 0}});
}

TEST(SvgPath, RotatedEllipseSatisfiesItsEquation) {
  // Half an ellipse of radii 20 and 10, turned by 30 degrees, around (0, 0).
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const auto polyline = ParseOne(fmt::format("M{} {} A 20 10 30 0 1 {} {}", 20 * c, 20 * s, -20 * c, -20 * s));
  ASSERT_GT(polyline.points.size(), 8U);
  for (const auto& point : polyline.points) {
    const double u = (c * point.x() + s * point.y()) / 20, v = (-s * point.x() + c * point.y()) / 10;
    EXPECT_NEAR(u * u + v * v, 1.0, 1e-9);
    EXPECT_GE(v, -1e-9);
  }
}

TEST(SvgPath, ErrorsSayThePosition) {
  const auto expect = [](const std::string& data, const std::string& part) {
    const auto error = ParseSvgPath(data, kTolerance).error;
    ASSERT_TRUE(error) << data;
    EXPECT_NE(error->find(part), std::string::npos) << *error;
  };
  expect("L1 2", "position 0: path data begin with 'L'");
  expect("M1 2 X3", "position 5: 'X' is not a command");
  expect("M1 2 L3", "position 7: the end, expected a number");
  expect("M1 2 L3 x", "position 8: 'x', expected a number");
  expect("M1 2,,3", "position 5");
  expect("M1 2 A5 5 0 2 1 3 3", "position 12: '2 1 3 3', expected a flag");
  expect("M1 2 L1e999 0", "position 6: '1e999 0', expected a finite number");
  expect("M1 2 Lnan 0", "position 6");
  expect("M1 2 Linf 0", "position 6");
  expect("M1e308 0 l1e308 0", "is not finite");
  EXPECT_FALSE(ParseSvgPath("M1 2L3 4Z", kTolerance).error);
  ExpectError([] { ParseSvgPath("M1 2", 0.0); }, "tolerance");
}

TEST(SvgPath, IsReadUpToTheSegmentOfTheFirstError) {
  ExpectPoints(ParseOne("M1 2L3 4 5 6 7"), {{1, 2}, {3, 4}, {5, 6}});
  ExpectPoints(ParseOne("M1 2L3 4QNaN NaN 5 6L7 8Z"), {{1, 2}, {3, 4}});
  ExpectPoints(ParseOne("M1 2L3 4C5 6 7 8"), {{1, 2}, {3, 4}});
  ExpectPoints(ParseOne("M1 2h3M5 x"), {{1, 2}, {4, 2}});
  EXPECT_TRUE(ParseSvgPath("MNaN 2L3 4", kTolerance).polylines.empty());
}

}  // namespace
}  // namespace daumier::render
