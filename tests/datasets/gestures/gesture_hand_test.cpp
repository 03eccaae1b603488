#include "datasets/gestures/gesture_hand.h"

#include "datasets/gestures/path_pen.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::datasets {
namespace {

const Polyline kBentShape = PathPen().Forward(1).Turn(1.5).Forward(0.7).points();

TEST(DrawWithHand, AMouseGivesWholePixelsAndNeighboursDiffer) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    GestureHand hand = DrawGestureHand({}, rng);
    hand.has_mouse = i % 2 == 0;
    const Polyline stroke = DrawWithHand(kBentShape, hand, rng);
    ASSERT_GE(stroke.size(), 2u);
    for (size_t p = 0; p < stroke.size(); ++p) {
      ASSERT_TRUE(stroke[p].allFinite());
      if (hand.has_mouse) EXPECT_EQ(stroke[p], stroke[p].array().round().matrix());
      if (p > 0) EXPECT_NE(stroke[p], stroke[p - 1]);
    }
  }
}

TEST(DrawWithHand, SizesAreInTheRange) {
  Rng rng(2);
  const GestureHandOptions options{.bend = 0, .rounding = 0, .tremor_px = 0, .smallest_px = 50, .largest_px = 60};
  for (int i = 0; i < 50; ++i) {
    const double size = BoxOf(DrawWithHand(kBentShape, DrawGestureHand(options, rng), rng)).sizes().maxCoeff();
    EXPECT_GT(size, 40);
    EXPECT_LT(size, 68) << "hooks at the ends may add some";
  }
}

TEST(DrawWithHand, SparseHandsLeaveFewPoints) {
  Rng rng(3);
  size_t num_dense = 0, num_sparse = 0;
  GestureHand hand = DrawGestureHand({}, rng);
  for (int i = 0; i < 50; ++i) {
    hand.sparse = 0;
    num_dense += DrawWithHand(kBentShape, hand, rng).size();
    hand.sparse = 1;
    num_sparse += DrawWithHand(kBentShape, hand, rng).size();
  }
  EXPECT_LT(num_sparse, num_dense / 2);
}

TEST(DrawGestureHand, RefusesSizesThatAreNoRange) {
  Rng rng(4);
  EXPECT_THROW(DrawGestureHand({.smallest_px = 100, .largest_px = 50}, rng), UsageError);
  testing::ExpectError([&] { DrawGestureHand({.smallest_px = 100, .largest_px = 50}, rng); },
                       "hand.smallest_px=100 is more than hand.largest_px=50");
}

}  // namespace
}  // namespace daumier::datasets
