#include "datasets/gestures/gesture_shapes.h"

#include "datasets/gestures/path_pen.h"
#include "datasets/gestures/stroke_form.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

constexpr int kNumDrawn = 200;

template <class Check>
void ForShapesOf(Gesture gesture, const Check& check) {
  for (int i = 0; i < kNumDrawn; ++i) {
    Rng rng = Stream(7, NameOf(gesture), uint64_t(i));
    const Polyline shape = DrawGestureShape(gesture, rng);
    check(shape, FormOf(shape));
    if (::testing::Test::HasFailure()) FAIL() << NameOf(gesture) << " " << i;
  }
}

/// The mean place of the ink along x, over the box: 0 at its left border, 1 at its right one.
double InkAlongX(const Polyline& line) {
  const Polyline even = Resampled(line, 200);
  double sum = 0;
  for (const auto& point : even) sum += point.x();
  return (sum / 200 - BoxOf(line).min().x()) / BoxOf(line).sizes().x();
}

TEST(GestureShapes, ALineDeviatesLittle) {
  ForShapesOf(Gesture::kLine, [](const Polyline&, const StrokeForm& of) { EXPECT_LT(of.deviation, 0.1); });
}

TEST(GestureShapes, TheEndsOfARegionMeet) {
  ForShapesOf(Gesture::kRegion, [](const Polyline& line, const StrokeForm& of) {
    EXPECT_LT(of.gap, 0.2);
    EXPECT_GT(BoxOf(line).sizes().minCoeff(), 0.1 * BoxOf(line).sizes().maxCoeff()) << "it lies around an area";
  });
}

TEST(GestureShapes, ARollTurnsOnceALoopAndClimbsOrFalls) {
  for (int loops = 1; loops <= 3; ++loops) {
    for (const bool climbs : {true, false}) {
      const auto gesture = Gesture(int(climbs ? Gesture::kUpRoll1 : Gesture::kDownRoll1) + loops - 1);
      ForShapesOf(gesture, [&](const Polyline& line, const StrokeForm& of) {
        EXPECT_NEAR(std::abs(of.turns), loops, 0.35);
        const Eigen::Vector2d way = line.back() - line.front();
        EXPECT_EQ(way.x() * way.y() < 0, climbs) << "y points down";
        const double slant = std::atan2(std::abs(way.y()), std::abs(way.x())) * 180 / std::numbers::pi;
        EXPECT_GT(slant, kLeastSlant - 0.1);
        EXPECT_LT(slant, kGreatestSlant + 0.1);
      });
    }
  }
}

TEST(GestureShapes, AnArrowIsLevelWithItsHookAtTheNamedEnd) {
  ForShapesOf(Gesture::kRightArrow, [](const Polyline& line, const StrokeForm&) {
    EXPECT_GT(InkAlongX(line), 0.5);
    EXPECT_GT(BoxOf(line).sizes().x(), 0.8 * BoxOf(line).sizes().y());
  });
  ForShapesOf(Gesture::kLeftArrow, [](const Polyline& line, const StrokeForm&) { EXPECT_LT(InkAlongX(line), 0.5); });
}

TEST(GestureShapes, AreDrawnInBothDirections) {
  for (int gesture = 0; gesture < kNumGestures; ++gesture) {
    int num_rightwards = 0;
    ForShapesOf(Gesture(gesture), [&](const Polyline& line, const StrokeForm& of) {
      num_rightwards += Gesture(gesture) == Gesture::kRegion ? of.turns > 0 : line.back().x() > line.front().x();
    });
    EXPECT_GT(num_rightwards, kNumDrawn / 20) << NameOf(Gesture(gesture));
    EXPECT_LT(num_rightwards, kNumDrawn - kNumDrawn / 20) << NameOf(Gesture(gesture));
  }
}

TEST(GestureShapes, NoneHasNoShape) {
  Rng rng(1);
  testing::ExpectError([&] { DrawGestureShape(Gesture::kNone, rng); }, "'none' has no shape");
}

TEST(DrawLoops, HasAsManyTurnsAsLoops) {
  for (int loops = 1; loops <= 6; ++loops) {
    Rng rng = Stream(3, "loops", uint64_t(loops));
    EXPECT_NEAR(std::abs(FormOf(DrawLoops(loops, rng)).turns), loops, 0.4);
  }
}

}  // namespace
}  // namespace daumier::datasets
