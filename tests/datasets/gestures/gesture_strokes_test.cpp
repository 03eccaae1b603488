#include "datasets/gestures/gesture_strokes.h"

#include "datasets/gestures/path_pen.h"
#include "datasets/gestures/stroke_form.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <set>

namespace daumier::datasets {
namespace {

TEST(StrokesOfHand, HasTheCountsOfEachKind) {
  const auto strokes = StrokesOfHand({}, {.per_gesture = 2, .none = 2 * kNumOtherStrokeKinds}, 1, 3);
  std::map<std::pair<Gesture, int>, int> counts;
  for (const LabelledStroke& stroke : strokes) {
    ++counts[{stroke.gesture, stroke.other ? int(*stroke.other) : -1}];
    EXPECT_EQ(stroke.hand, 3);
    EXPECT_EQ(stroke.other.has_value(), stroke.gesture == Gesture::kNone);
  }
  EXPECT_EQ(counts.size(), size_t{kNumGestures + kNumOtherStrokeKinds});
  for (const auto& [kind, count] : counts) EXPECT_EQ(count, 2);
}

TEST(StrokesOfHand, AreAFunctionOfSeedAndHand) {
  const GestureCounts counts{.per_gesture = 1, .none = 5};
  const auto points = [&](uint64_t seed, int hand) {
    std::vector<Polyline> lines;
    for (const LabelledStroke& stroke : StrokesOfHand({}, counts, seed, hand)) lines.push_back(stroke.points);
    return lines;
  };
  EXPECT_EQ(points(1, 2), points(1, 2));
  EXPECT_NE(points(1, 2), points(1, 3));
  EXPECT_NE(points(1, 2), points(2, 2));
}

TEST(StrokesOfHand, GesturesKeepTheirDefinition) {
  for (int hand = 0; hand < 8; ++hand) {
    for (const LabelledStroke& stroke : StrokesOfHand({}, {.per_gesture = 4, .none = 0}, 5, hand)) {
      EXPECT_TRUE(KeepsDefinition(stroke.gesture, stroke.points)) << NameOf(stroke.gesture);
      const StrokeForm form = FormOf(stroke.points);
      const bool is_up = stroke.gesture >= Gesture::kUpRoll1 && stroke.gesture <= Gesture::kUpRoll3;
      const bool is_down = stroke.gesture >= Gesture::kDownRoll1;
      if (is_up || is_down) EXPECT_EQ(std::sin(2 * form.direction) < 0, is_up) << NameOf(stroke.gesture);
    }
  }
}

TEST(KeepsDefinition, MeasuresLinesRegionsAndRolls) {
  const auto loops = [](int count) {
    PathPen pen(-0.7);
    for (int i = 0; i < count; ++i) pen.Forward(1).Arc(2 * std::numbers::pi, 0.4);
    return pen.Forward(1).points();
  };
  EXPECT_TRUE(KeepsDefinition(Gesture::kUpRoll2, loops(2)));
  EXPECT_FALSE(KeepsDefinition(Gesture::kUpRoll2, loops(3)));
  EXPECT_TRUE(KeepsDefinition(Gesture::kDownRoll3, loops(3)));
  EXPECT_TRUE(KeepsDefinition(Gesture::kLine, {{0, 0}, {5, 0.2}, {9, 0}}));
  EXPECT_FALSE(KeepsDefinition(Gesture::kLine, {{0, 0}, {5, 3}, {9, 0}}));
  EXPECT_TRUE(KeepsDefinition(Gesture::kRegion, {{0, 0}, {5, 0}, {5, 5}, {0, 5}, {0, 1}}));
  EXPECT_FALSE(KeepsDefinition(Gesture::kRegion, {{0, 0}, {5, 0}, {5, 5}}));
}

}  // namespace
}  // namespace daumier::datasets
