#include "datasets/styles/eye_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using enum faces::FacePoint;
using testing::PartDrawing;

constexpr EyeStyles kNoEyes = {.almond = 0, .upper_lid = 0, .circle = 0, .dot = 0, .dash = 0, .closed = 0, .wink = 0};

PartDrawing DrawnEyes(const EyeStyles& styles, uint64_t seed, FaceShape shape = testing::PlainFaceShape()) {
  PartDrawing drawing{.shape = std::move(shape), .rng = Rng(seed)};
  drawing.styles.eyes = styles;
  DrawEyes(drawing.context());
  testing::ExpectWholeLines(drawing.sheet);
  return drawing;
}

TEST(DrawEyes, LidsCarryTheFourPoints) {
  EyeStyles styles = kNoEyes;
  styles.almond = 1;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const PartDrawing drawing = DrawnEyes(styles, seed);
    EXPECT_EQ(*drawing.At(kEyeRightOuter), Eigen::Vector2d(95, 120));
    EXPECT_EQ(*drawing.At(kEyeRightInner), Eigen::Vector2d(117, 120));
    EXPECT_EQ(*drawing.At(kEyeLeftOuter), Eigen::Vector2d(161, 120));
    EXPECT_EQ(*drawing.At(kEyeLeftTop), Eigen::Vector2d(150, 115));
    EXPECT_EQ(*drawing.At(kEyeRightBottom), Eigen::Vector2d(106, 124));
    EXPECT_EQ(drawing.sheet.eyes[0], faces::EyeState::kOpen);
    EXPECT_GT(drawing.NumLines(faces::LineLabel::kLowerLid), 1);
  }
}

TEST(DrawEyes, AClosedEyeIsOneLineAtWhichTopAndBottomAre) {
  EyeStyles styles = kNoEyes;
  styles.almond = styles.closed = 1;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    const PartDrawing drawing = DrawnEyes(styles, seed);
    for (size_t side = 0; side < 2; ++side) EXPECT_EQ(drawing.sheet.eyes[side], faces::EyeState::kClosed);
    EXPECT_EQ(drawing.At(kEyeRightTop), drawing.At(kEyeRightBottom));
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kLowerLid) + drawing.NumLines(faces::LineLabel::kIris), 0);
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kUpperLid), 2);
  }
  FaceShape blinking = testing::PlainFaceShape();
  blinking.eyes[1].is_closed = true;
  styles.closed = 0;
  const PartDrawing drawing = DrawnEyes(styles, 1, blinking);
  EXPECT_EQ(drawing.sheet.eyes[0], faces::EyeState::kOpen);
  EXPECT_EQ(drawing.sheet.eyes[1], faces::EyeState::kClosed);
}

TEST(DrawEyes, AWinkClosesOneEye) {
  EyeStyles styles = kNoEyes;
  styles.almond = styles.wink = 1;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const PartDrawing drawing = DrawnEyes(styles, seed);
    EXPECT_NE(drawing.sheet.eyes[0], drawing.sheet.eyes[1]);
  }
}

TEST(DrawEyes, MarksHaveACentreAloneAndNoState) {
  for (double EyeStyles::*kind : {&EyeStyles::dot, &EyeStyles::dash}) {
    EyeStyles styles = kNoEyes;
    styles.*kind = 1;
    const PartDrawing drawing = DrawnEyes(styles, 2);
    EXPECT_FALSE(drawing.sheet.eyes[0] || drawing.sheet.eyes[1]);
    EXPECT_LT((*drawing.sheet.eye_centres[0] - Eigen::Vector2d(106, 120)).norm(), 2);
    for (const faces::FacePoint point : {kEyeRightOuter, kEyeRightInner, kEyeRightTop, kEyeRightBottom})
      EXPECT_FALSE(drawing.At(point));
    EXPECT_EQ(drawing.sheet.lines.size(), 2u);
  }
}

TEST(DrawEyes, OvalsHaveTheirPointsAtTheirExtremes) {
  EyeStyles styles = kNoEyes;
  styles.circle = 1;
  styles.iris = 1;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const PartDrawing drawing = DrawnEyes(styles, seed);
    const Polyline& oval = drawing.sheet.lines.front().points;
    const Eigen::AlignedBox2d box = BoxOf(oval);
    EXPECT_NEAR(drawing.At(kEyeRightOuter)->x(), box.min().x(), 1e-9);
    EXPECT_NEAR(drawing.At(kEyeRightInner)->x(), box.max().x(), 1e-9);
    EXPECT_NEAR(drawing.At(kEyeRightTop)->y(), box.min().y(), 1e-9);
    EXPECT_NEAR(drawing.At(kEyeRightBottom)->y(), box.max().y(), 1e-9);
    EXPECT_GT(drawing.At(kEyeLeftOuter)->x(), drawing.At(kEyeLeftInner)->x());
  }
}

TEST(DrawEyes, IrisesLieBetweenTheLids) {
  EyeStyles styles = kNoEyes;
  styles.almond = styles.iris = 1;
  for (uint64_t seed = 0; seed < 30; ++seed) {
    const PartDrawing drawing = DrawnEyes(styles, seed);
    for (const StyledLine& line : drawing.sheet.lines) {
      if (line.labels.front() != faces::LineLabel::kIris || line.care == LineCare::kMark) continue;
      for (const Eigen::Vector2d& point : line.points) {
        EXPECT_GE(point.y(), 115 - 1e-6);
        EXPECT_LE(point.y(), 124 + 1e-6);
      }
    }
  }
}

TEST(DrawEyes, AnUnseenEyeIsNotDrawn) {
  FaceShape shape = testing::PlainFaceShape();
  shape.eyes[0] = {};
  EyeStyles styles = kNoEyes;
  styles.almond = 1;
  const PartDrawing drawing = DrawnEyes(styles, 1, shape);
  EXPECT_FALSE(drawing.sheet.eyes[0] || drawing.At(kEyeRightOuter));
  EXPECT_TRUE(drawing.sheet.eyes[1] && drawing.At(kEyeLeftOuter));
}

}  // namespace
}  // namespace daumier::datasets
