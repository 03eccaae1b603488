#include "datasets/styles/page_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

TEST(PageLines, AreAllOfTheLabelOther) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    PartDrawing drawing{.rng = Rng(seed)};
    drawing.styles.extras.hatching = drawing.styles.extras.construction = drawing.styles.extras.page_marks = 1;
    DrawHatching(drawing.context());
    DrawConstruction(drawing.context());
    drawing.sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, drawing.shape.outline);
    DrawPageMarks(drawing.context());
    testing::ExpectWholeLines(drawing.sheet);
    EXPECT_GE(drawing.NumLines(faces::LineLabel::kOther), 1);
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kOther), int(drawing.sheet.lines.size()) - 1);
  }
}

TEST(PageLines, MarksSurroundWhatIsThere) {
  PartDrawing drawing;
  drawing.styles.extras.page_marks = 1;
  DrawPageMarks(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty()) << "an empty page has no frame";
}

}  // namespace
}  // namespace daumier::datasets
