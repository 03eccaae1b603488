#include "datasets/gestures/other_strokes.h"

#include "datasets/gestures/stroke_measures.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

TEST(OtherStroke, HasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kNumOtherStrokes; ++i) names.insert(NameOf(OtherStroke(i)));
  EXPECT_EQ(names.size(), size_t{kNumOtherStrokes});
  EXPECT_EQ(NameOf(OtherStroke::kWandering), "wandering");
}

TEST(OtherShapes, AreNeitherNearlyStraightNorNearlyClosed) {
  for (int kind = 0; kind < kNumOtherStrokes; ++kind) {
    for (int i = 0; i < 60; ++i) {
      Rng rng = Stream(1, "others", uint64_t(kind * 1000 + i));
      const StrokeMeasures measures = MeasureStroke(DrawOtherShape(OtherStroke(kind), rng));
      EXPECT_FALSE(measures.is_nearly_straight()) << NameOf(OtherStroke(kind)) << " " << i;
      EXPECT_FALSE(measures.is_nearly_closed()) << NameOf(OtherStroke(kind)) << " " << i;
    }
  }
}

TEST(OtherShapes, DrawnWithoutRegardToGesturesAreCheckedForAllOfThem) {
  for (const OtherStroke kind : {OtherStroke::kWandering, OtherStroke::kScribble}) {
    for (int i = 0; i < 60; ++i) {
      Rng rng = Stream(2, "others", uint64_t(i));
      EXPECT_FALSE(MayBeGesture(DrawOtherShape(kind, rng))) << NameOf(kind) << " " << i;
    }
  }
}

}  // namespace
}  // namespace daumier::datasets
