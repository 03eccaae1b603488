#include "datasets/styles/hat_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

TEST(DrawHat, HidesTheCrownAndNotTheMouth) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    PartDrawing drawing{.rng = Rng(seed)};
    drawing.styles.extras.hat = 1;
    drawing.sheet.Add(DrawnPart::kHair, faces::LineLabel::kHair, {{128, 68}, {128, 66}});
    drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, {{120, 165}, {130, 165}});
    DrawHat(drawing.context());
    testing::ExpectWholeLines(drawing.sheet);
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kHair), 0) << seed;
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kInnerMouth), 1) << seed;
    EXPECT_GE(drawing.NumLines(faces::LineLabel::kOther), 2) << seed;
  }
}

TEST(DrawHat, ProfilesHaveNone) {
  PartDrawing drawing;
  drawing.styles.extras.hat = 1;
  drawing.shape.view = faces::DrawnView::kProfile;
  DrawHat(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

}  // namespace
}  // namespace daumier::datasets
