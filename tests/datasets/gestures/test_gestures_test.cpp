#include "datasets/gestures/test_gestures.h"

#include "tests/datasets/gestures/stroke_measures.h"

#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace daumier::datasets {
namespace {

constexpr int kStrokesOfAClass = 200;

Polyline TestStroke(Gesture gesture, int index) {
  Rng rng = Stream(5, NameOf(gesture), static_cast<uint64_t>(index));
  return DrawTestGesture(gesture, rng);
}

TEST(DrawTestGesture, IsAFunctionOfItsSeedInEveryThread) {
  std::vector<Polyline> strokes(4 * (kNumGestures + 1));
  std::vector<std::thread> threads;
  for (size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&strokes, t] {
      for (size_t g = 0; g <= kNumGestures; ++g) {
        strokes[t * (kNumGestures + 1) + g] = TestStroke(static_cast<Gesture>(g), 0);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (size_t i = kNumGestures + 1; i < strokes.size(); ++i) EXPECT_EQ(strokes[i], strokes[i % (kNumGestures + 1)]);
  EXPECT_NE(TestStroke(Gesture::kLine, 1), TestStroke(Gesture::kLine, 2));
}

TEST(DrawTestGesture, PointsAreFiniteOnASheet) {
  for (int g = 0; g <= kNumGestures; ++g) {
    for (int i = 0; i < kStrokesOfAClass; ++i) {
      const Polyline stroke = TestStroke(static_cast<Gesture>(g), i);
      ASSERT_GE(stroke.size(), 2u);
      for (const Eigen::Vector2d& point : stroke) {
        EXPECT_TRUE(point.allFinite());
        EXPECT_LT(point.cwiseAbs().maxCoeff(), 1400);
      }
      if (g < kNumGestures) {
        EXPECT_GT(BoxOf(stroke).sizes().maxCoeff(), 33);
        EXPECT_LT(BoxOf(stroke).sizes().maxCoeff(), 660);
      }
    }
  }
}

TEST(DrawTestGesture, AStrokeFulfilsTheDefinitionOfItsClassAlone) {
  for (int g = 0; g < kNumGestures; ++g) {
    const auto gesture = static_cast<Gesture>(g);
    int num_right = 0, num_other = 0;
    for (int i = 0; i < kStrokesOfAClass; ++i) {
      const std::vector<Gesture> gestures = GesturesByDefinition(TestStroke(gesture, i));
      num_right += std::count(gestures.begin(), gestures.end(), gesture) > 0 ? 1 : 0;
      num_other += gestures.size() > 1 ? 1 : 0;
    }
    // A hand may fail, and the measures are coarse: a roll of one loop with a long end resembles a shaft.
    EXPECT_GE(num_right, kStrokesOfAClass - 3) << NameOf(gesture);
    EXPECT_LE(num_other, 5) << NameOf(gesture);
  }
}

TEST(DrawTestGesture, AnotherStrokeFulfilsNone) {
  int num_wrong = 0;
  for (int i = 0; i < kStrokesOfAClass; ++i) {
    num_wrong += GesturesByDefinition(TestStroke(Gesture::kNone, i)).empty() ? 0 : 1;
  }
  EXPECT_LE(num_wrong, 2);
}

TEST(DrawTestGesture, LinesHaveEveryDirectionAndArrowsRunEitherWay) {
  std::set<int> directions;
  int num_from_tail = 0;
  for (int i = 0; i < kStrokesOfAClass; ++i) {
    directions.insert(static_cast<int>(MeasureStroke(TestStroke(Gesture::kLine, i)).rise + 180) / 30);
    const Polyline arrow = TestStroke(Gesture::kRightArrow, i);
    num_from_tail += arrow.front().x() < arrow.back().x() ? 1 : 0;
  }
  EXPECT_GE(directions.size(), 12u);
  EXPECT_GT(num_from_tail, 0.65 * kStrokesOfAClass);
  EXPECT_LT(num_from_tail, 0.95 * kStrokesOfAClass);
}

}  // namespace
}  // namespace daumier::datasets
