#include "datasets/gestures/other_plans.h"

#include "tests/datasets/gestures/stroke_measures.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::datasets {
namespace {

Polyline DrawnOtherStroke(OtherStroke kind, uint64_t index) {
  Rng rng = Stream(3, "other", index);
  const PenPlan plan = PlanOtherStroke(kind, rng);
  return MovePen(plan, DrawWriterHand(rng), rng);
}

TEST(PlanOtherStroke, AHandDrawsNoGestureFromIt) {
  for (int kind = 0; kind < kNumOtherStrokes; ++kind) {
    int num_wrong = 0;
    for (uint64_t i = 0; i < 100; ++i) {
      const Polyline stroke = DrawnOtherStroke(static_cast<OtherStroke>(kind), i);
      num_wrong += GesturesByDefinition(stroke).empty() ? 0 : 1;
    }
    EXPECT_LE(num_wrong, 2) << kind;
  }
}

TEST(PlanOtherStroke, ArcsAreFarFromLinesAndRegions) {
  for (uint64_t i = 0; i < 100; ++i) {
    const StrokeMeasures measures = MeasureStroke(DrawnOtherStroke(OtherStroke::kArc, i));
    EXPECT_GT(measures.bow, 0.1);
    EXPECT_GT(measures.gap, 0.3);
  }
}

TEST(PlanOtherStroke, ALongRollHasFourToSixLoops) {
  for (uint64_t i = 0; i < 100; ++i) {
    const double turns = MeasureStroke(DrawnOtherStroke(OtherStroke::kLongRoll, i)).turns;
    EXPECT_GT(turns, 3.4);
    EXPECT_LT(turns, 6.6);
  }
}

TEST(PlanOtherStroke, AFlatCoilNeitherRisesNorFallsAslant) {
  for (uint64_t i = 0; i < 100; ++i) {
    const double rise = std::abs(MeasureStroke(DrawnOtherStroke(OtherStroke::kFlatCoil, i)).rise);
    EXPECT_TRUE(rise < 11 || std::abs(rise - 90) < 11) << rise;
  }
}

TEST(PlanOtherStroke, DotsAndHooksAreSmall) {
  for (uint64_t i = 0; i < 100; ++i) {
    EXPECT_LT(BoxOf(DrawnOtherStroke(OtherStroke::kDot, i)).sizes().maxCoeff(), 15);
    EXPECT_LT(BoxOf(DrawnOtherStroke(OtherStroke::kShortHook, i)).sizes().maxCoeff(), 45);
  }
  Rng rng(1);
  testing::ExpectError([&] { PlanOtherStroke(static_cast<OtherStroke>(kNumOtherStrokes), rng); }, "no such stroke");
}

}  // namespace
}  // namespace daumier::datasets
