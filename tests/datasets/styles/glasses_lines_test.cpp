#include "datasets/styles/glasses_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

TEST(DrawGlasses, LensesSurroundTheEyes) {
  for (uint64_t seed = 0; seed < 30; ++seed) {
    PartDrawing drawing{.rng = Rng(seed)};
    drawing.styles.extras.glasses = 1;
    DrawGlasses(drawing.context());
    testing::ExpectWholeLines(drawing.sheet);
    ASSERT_GE(drawing.sheet.lines.size(), 3u);
    EXPECT_TRUE(IsInside(drawing.sheet.lines[0].points, {106, 120}));
    EXPECT_TRUE(IsInside(drawing.sheet.lines[1].points, {150, 120}));
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kOther), int(drawing.sheet.lines.size()));
  }
}

TEST(DrawGlasses, NeedBothEyes) {
  PartDrawing drawing;
  drawing.styles.extras.glasses = 1;
  drawing.shape.eyes[1] = {};
  DrawGlasses(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

}  // namespace
}  // namespace daumier::datasets
