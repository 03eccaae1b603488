#include "datasets/styles/brow_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using enum faces::FacePoint;
using testing::PartDrawing;

TEST(DrawBrows, EveryStyleHasBothEndsOfBothBrows) {
  for (double BrowStyles::*kind : {&BrowStyles::outline, &BrowStyles::line, &BrowStyles::fill, &BrowStyles::strokes}) {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      PartDrawing drawing{.rng = Rng(seed)};
      drawing.styles.brows = {.outline = 0, .line = 0, .fill = 0, .strokes = 0, .none = 0};
      drawing.styles.brows.*kind = 1;
      DrawBrows(drawing.context());
      testing::ExpectWholeLines(drawing.sheet);
      for (const auto& [point, x] : {std::pair{kBrowRightOuter, 92.0},
                                     {kBrowRightInner, 118.0},
                                     {kBrowLeftInner, 138.0},
                                     {kBrowLeftOuter, 164.0}}) {
        ASSERT_TRUE(drawing.At(point)) << faces::kFacePointNames[size_t(point)];
        EXPECT_NEAR(drawing.At(point)->x(), x, 3.0) << faces::kFacePointNames[size_t(point)];
      }
      EXPECT_EQ(drawing.NumLines(faces::LineLabel::kBrow), int(drawing.sheet.lines.size()));
    }
  }
}

TEST(DrawBrows, FilledOnesAreAreas) {
  PartDrawing drawing;
  drawing.styles.brows = {.outline = 0, .line = 0, .fill = 1, .strokes = 0, .none = 0};
  DrawBrows(drawing.context());
  ASSERT_EQ(drawing.sheet.lines.size(), 2u);
  EXPECT_TRUE(drawing.sheet.lines[0].filled);
}

TEST(DrawBrows, ThereMayBeNone) {
  PartDrawing drawing;
  drawing.styles.brows.none = 1;
  DrawBrows(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

}  // namespace
}  // namespace daumier::datasets
