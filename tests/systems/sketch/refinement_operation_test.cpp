#include "systems/sketch/refinement_operation.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using What = RefinementOperation::What;
using enum datasets::Gesture;

const CanvasPoints kStroke = {{1, 2}, {30, 4}};

RefinementOperation MeaningOf(datasets::Gesture gesture, bool has_handles = true) {
  const auto operation = OperationOf(gesture, kStroke, {30, -10}, has_handles);
  EXPECT_TRUE(operation.has_value());
  return operation.value_or(RefinementOperation());
}

TEST(OperationOf, RollsMoveTheHandlesByTheirLoops) {
  for (int loops = 1; loops <= 3; ++loops) {
    const RefinementOperation up = MeaningOf(datasets::Gesture(int(kUpRoll1) + loops - 1));
    EXPECT_EQ(up.what, What::kRoll);
    EXPECT_EQ(up.level, loops);
    EXPECT_EQ(up.view.yaw_degrees, 30);
    EXPECT_EQ(up.view.pitch_degrees, -10);
    EXPECT_EQ(MeaningOf(datasets::Gesture(int(kDownRoll1) + loops - 1)).level, -loops);
  }
}

TEST(OperationOf, ALineMovesHandlesOrTheSilhouette) {
  EXPECT_EQ(MeaningOf(kLine).what, What::kTranslate);
  EXPECT_EQ(MeaningOf(kLine, /*has_handles=*/false).what, What::kPull);
  EXPECT_EQ(MeaningOf(kLine).points, kStroke);
}

TEST(OperationOf, ARegionIsOneWhateverTheHandles) {
  for (const bool has_handles : {true, false}) {
    const RefinementOperation region = MeaningOf(kRegion, has_handles);
    EXPECT_EQ(region.what, What::kRegion);
    EXPECT_EQ(region.points, kStroke);
    EXPECT_EQ(region.view.yaw_degrees, 30);
  }
}

TEST(OperationOf, ArrowsAndOtherStrokesAreNoOperation) {
  for (const datasets::Gesture gesture : {kLeftArrow, kRightArrow, kNone})
    EXPECT_FALSE(OperationOf(gesture, kStroke, {}, true).has_value());
}

}  // namespace
}  // namespace daumier::sketch
