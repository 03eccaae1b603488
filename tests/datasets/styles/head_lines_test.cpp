#include "datasets/styles/head_lines.h"

#include "tests/support/plain_face_shape.h"

#include <cmath>

namespace daumier::datasets {
namespace {

using enum faces::FacePoint;
using testing::PartDrawing;

TEST(DrawOutline, ChinAndContourLieOnTheHeadAtTheHeightOfTheMouth) {
  for (const HeadBorder border : {HeadBorder::kWhole, HeadBorder::kOpenTop}) {
    PartDrawing drawing;
    DrawOutline(drawing.context(), border);
    testing::ExpectWholeLines(drawing.sheet);
    EXPECT_LT((*drawing.At(kChin) - Eigen::Vector2d(128, 195)).norm(), 1e-6);
    // x = 128 +- 50 sqrt(1 - (35.25 / 65)^2) at the mouth, up to the spacing of the outline's points.
    EXPECT_NEAR(drawing.At(kContourRight)->y(), 165.25, 3);
    EXPECT_NEAR(drawing.At(kContourRight)->x(), 86, 3);
    EXPECT_NEAR(drawing.At(kContourLeft)->x(), 170, 3);
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kSilhouette), int(drawing.sheet.lines.size()));
  }
}

TEST(DrawOutline, AnOpenTopLeavesTheSkullOut) {
  PartDrawing whole, open;
  DrawOutline(whole.context(), HeadBorder::kWhole);
  DrawOutline(open.context(), HeadBorder::kOpenTop);
  const auto top = [](const PartDrawing& drawing) {
    Eigen::AlignedBox2d box;
    for (const StyledLine& line : drawing.sheet.lines) box.extend(BoxOf(line.points));
    return box.min().y();
  };
  EXPECT_NEAR(top(whole), 65, 0.5);
  EXPECT_GT(top(open), 120);
}

TEST(DrawOutline, OfAProfileTheNoseMeetsTheLip) {
  PartDrawing drawing;
  drawing.shape.view = faces::DrawnView::kProfile;
  // Forehead, nose out to the right, lip, chin, neck.
  drawing.shape.outline =
      Resampled({{150, 80}, {155, 115}, {175, 140}, {158, 148}, {162, 158}, {158, 180}, {140, 200}}, 49);
  drawing.shape.chin = NearestIndex(drawing.shape.outline, {158, 180});
  drawing.shape.mouth.top.back() = {162, 158};
  drawing.shape.mouth.middle = MouthShape::kPoints - 1;
  DrawOutline(drawing.context(), HeadBorder::kWhole);
  EXPECT_LT((*drawing.At(kNoseBottom) - Eigen::Vector2d(158, 148)).norm(), 4);
  EXPECT_FALSE(drawing.At(kContourRight));
}

TEST(DrawEars, AreThereInnerOnesToo) {
  PartDrawing drawing;
  drawing.styles.head.ears = drawing.styles.head.inner_ears = 1;
  DrawEars(drawing.context());
  EXPECT_EQ(drawing.NumLines(faces::LineLabel::kEar), 4);
  drawing = {};
  drawing.styles.head.ears = 0;
  DrawEars(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

TEST(DrawSkin, FoldsAreWrinklesAndFrecklesAreNot) {
  PartDrawing drawing;
  drawing.styles.head = {.wrinkles = 1, .folds = 1, .freckles = 1, .cheeks = 1};
  DrawSkin(drawing.context());
  testing::ExpectWholeLines(drawing.sheet);
  EXPECT_GT(drawing.NumLines(faces::LineLabel::kOther), 1);
  for (const StyledLine& line : drawing.sheet.lines) EXPECT_EQ(line.part, DrawnPart::kSkin);
}

}  // namespace
}  // namespace daumier::datasets
