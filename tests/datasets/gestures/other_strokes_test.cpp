#include "datasets/gestures/other_strokes.h"

#include "datasets/gestures/stroke_form.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

TEST(OtherStrokeKind, HasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i < kNumOtherStrokeKinds; ++i) names.insert(NameOf(OtherStrokeKind(i)));
  EXPECT_EQ(names.size(), size_t{kNumOtherStrokeKinds});
  EXPECT_EQ(NameOf(OtherStrokeKind::kWandering), "wandering");
}

TEST(OtherShapes, AreNeitherNearlyStraightNorNearlyClosed) {
  for (int kind = 0; kind < kNumOtherStrokeKinds; ++kind) {
    for (int i = 0; i < 60; ++i) {
      Rng rng = Stream(1, "others", uint64_t(kind * 1000 + i));
      const StrokeForm form = FormOf(DrawOtherShape(OtherStrokeKind(kind), rng));
      EXPECT_FALSE(form.is_nearly_straight()) << NameOf(OtherStrokeKind(kind)) << " " << i;
      EXPECT_FALSE(form.is_nearly_closed()) << NameOf(OtherStrokeKind(kind)) << " " << i;
    }
  }
}

TEST(OtherShapes, DrawnWithoutRegardToGesturesAreCheckedForAllOfThem) {
  for (const OtherStrokeKind kind : {OtherStrokeKind::kWandering, OtherStrokeKind::kScribble}) {
    for (int i = 0; i < 60; ++i) {
      Rng rng = Stream(2, "others", uint64_t(i));
      EXPECT_FALSE(MayBeGesture(DrawOtherShape(kind, rng))) << NameOf(kind) << " " << i;
    }
  }
}

}  // namespace
}  // namespace daumier::datasets
