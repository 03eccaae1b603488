#include "datasets/styles/mouth_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using enum faces::FacePoint;
using testing::PartDrawing;

PartDrawing DrawnMouth(FaceShape shape, uint64_t seed, const MouthStyles& styles = {}) {
  PartDrawing drawing{.shape = std::move(shape), .rng = Rng(seed)};
  drawing.styles.mouth = styles;
  DrawMouth(drawing.context());
  testing::ExpectWholeLines(drawing.sheet);
  return drawing;
}

TEST(DrawMouth, AClosedMouthHasOneSeamAndNoTeeth) {
  MouthStyles styles;
  styles.opened = 0;
  for (uint64_t seed = 0; seed < 50; ++seed) {
    const PartDrawing drawing = DrawnMouth(testing::PlainFaceShape(), seed, styles);
    EXPECT_EQ(drawing.sheet.mouth, faces::MouthState::kClosed);
    EXPECT_LE(drawing.NumLines(faces::LineLabel::kInnerMouth), 1);
    EXPECT_EQ(drawing.At(kInnerTop).has_value(), drawing.NumLines(faces::LineLabel::kInnerMouth) == 1);
    EXPECT_EQ(drawing.At(kInnerTop), drawing.At(kInnerBottom));
    ASSERT_TRUE(drawing.At(kMouthRight) && drawing.At(kMouthLeft));
    EXPECT_LT((*drawing.At(kMouthRight) - Eigen::Vector2d(108, 165)).norm(), 1e-9);
    EXPECT_LT((*drawing.At(kMouthLeft) - Eigen::Vector2d(148, 165)).norm(), 1e-9);
    if (drawing.At(kLipTop)) {
      EXPECT_EQ(drawing.At(kLipTop)->y(), 160);
    }
    if (drawing.At(kLipBottom)) {
      EXPECT_EQ(drawing.At(kLipBottom)->y(), 173);
    }
  }
}

TEST(DrawMouth, AnOpenMouthHasBothEdges) {
  int num_teeth = 0, num_without_lips = 0;
  for (uint64_t seed = 0; seed < 80; ++seed) {
    const PartDrawing drawing = DrawnMouth(testing::OpenMouthShape(), seed, {.closed = 0});
    ASSERT_TRUE(drawing.sheet.mouth);
    EXPECT_NE(*drawing.sheet.mouth, faces::MouthState::kClosed);
    ASSERT_TRUE(drawing.At(kInnerTop) && drawing.At(kInnerBottom));
    EXPECT_NEAR(drawing.At(kInnerBottom)->y() - drawing.At(kInnerTop)->y(), 12, 1e-9);
    num_teeth += *drawing.sheet.mouth == faces::MouthState::kTeeth ? 1 : 0;
    num_without_lips += drawing.At(kLipTop) ? 0 : 1;
  }
  EXPECT_GT(num_teeth, 15);
  EXPECT_GT(num_without_lips, 5);
}

TEST(DrawMouth, AClosedMouthMayBeDrawnOpen) {
  MouthStyles styles;
  styles.opened = 1;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const PartDrawing drawing = DrawnMouth(testing::PlainFaceShape(), seed, styles);
    EXPECT_NE(*drawing.sheet.mouth, faces::MouthState::kClosed);
    EXPECT_GT(drawing.At(kInnerBottom)->y() - drawing.At(kInnerTop)->y(), 4);
  }
}

TEST(DrawMouth, AnOpenMouthMayBeDrawnClosed) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const PartDrawing drawing = DrawnMouth(testing::OpenMouthShape(), seed, {.closed = 1});
    EXPECT_EQ(drawing.sheet.mouth, faces::MouthState::kClosed);
    EXPECT_EQ(drawing.At(kInnerTop), drawing.At(kInnerBottom));
    if (!drawing.At(kLipTop) || !drawing.At(kLipBottom)) continue;
    // The lips, 6 and 7 thick at their middles, lie against each other.
    EXPECT_NEAR(drawing.At(kLipBottom)->y() - drawing.At(kLipTop)->y(), 13, 1e-9);
  }
}

TEST(DrawMouth, EachWeightSelectsItsStyle) {
  const MouthStyles none = {.outline_and_middle = 0, .outline = 0, .middle = 0, .upper_and_middle = 0, .opened = 0};
  MouthStyles styles = none;
  styles.middle = 1;
  PartDrawing drawing = DrawnMouth(testing::PlainFaceShape(), 3, styles);
  EXPECT_FALSE(drawing.At(kLipTop) || drawing.At(kLipBottom));
  EXPECT_TRUE(drawing.At(kInnerTop));
  styles = none;
  styles.outline = 1;
  drawing = DrawnMouth(testing::PlainFaceShape(), 3, styles);
  EXPECT_TRUE(drawing.At(kLipTop) && drawing.At(kLipBottom));
  EXPECT_FALSE(drawing.At(kInnerTop));
  EXPECT_EQ(drawing.NumLines(faces::LineLabel::kInnerMouth), 0);
  styles = none;
  styles.none = 1;
  EXPECT_FALSE(DrawnMouth(testing::PlainFaceShape(), 3, styles).sheet.mouth.has_value());
}

}  // namespace
}  // namespace daumier::datasets
