#include "datasets/gestures/drawing_strokes.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

TEST(DrawingStroke, IsASmoothLineOfManyPoints) {
  Rng rng(2);
  for (int i = 0; i < 100; ++i) {
    const Polyline line = DrawingStroke(rng);
    EXPECT_EQ(line.size(), 240u);
    EXPECT_GT(LengthOf(line), 1);
    for (const auto& point : line) EXPECT_TRUE(point.allFinite());
  }
}

TEST(DrawingStroke, IsAFunctionOfTheStreamAlone) {
  Rng one(9), again(9);
  EXPECT_EQ(DrawingStroke(one), DrawingStroke(again));
}

}  // namespace
}  // namespace daumier::datasets
