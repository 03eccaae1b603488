#include "datasets/styles/bust_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

TEST(DrawBust, LiesBehindTheHead) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    PartDrawing drawing{.rng = Rng(seed)};
    drawing.styles.extras = {.neck = 1, .shoulders = 1, .collar = 1};
    DrawBust(drawing.context());
    testing::ExpectWholeLines(drawing.sheet);
    EXPECT_GE(drawing.NumLines(faces::LineLabel::kNeck), 4) << "two sides of a neck and two shoulders";
    const Polyline head = drawing.shape.head();
    for (const StyledLine& line : drawing.sheet.lines)
      for (size_t i = 1; i + 1 < line.points.size(); ++i) EXPECT_FALSE(IsInside(head, line.points[i])) << seed;
  }
}

TEST(DrawBust, WithoutANeckThereIsNothing) {
  PartDrawing drawing;
  drawing.styles.extras.neck = 0;
  DrawBust(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

TEST(DrawEarrings, HangBelowTheEarsThatAreDrawn) {
  PartDrawing drawing;
  drawing.styles.extras.earrings = 1;
  DrawEarrings(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty()) << "no ears, no rings";
  drawing.sheet.Add(DrawnPart::kEars, faces::LineLabel::kEar, drawing.shape.ears[0].outer);
  DrawEarrings(drawing.context());
  EXPECT_GE(drawing.NumLines(faces::LineLabel::kOther), 1);
  const Eigen::AlignedBox2d ring = BoxOf(drawing.sheet.lines.back().points);
  EXPECT_NEAR(ring.center().x(), 79, 6);
  EXPECT_GT(ring.max().y(), 146);
}

}  // namespace
}  // namespace daumier::datasets
