#include "datasets/styles/beard_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

PartDrawing DrawnBeard(double HairStyles::*kind, uint64_t seed) {
  PartDrawing drawing{.rng = Rng(seed)};
  drawing.styles.hair.beard = drawing.styles.hair.moustache = drawing.styles.hair.stubble = 0;
  drawing.styles.hair.*kind = 1;
  drawing.sheet.mouth = faces::MouthState::kClosed;
  drawing.sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, drawing.shape.outline,
                    {{faces::FacePoint::kChin, 24}});
  drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, drawing.shape.mouth.inner_top);
  DrawBeard(drawing.context());
  testing::ExpectWholeLines(drawing.sheet);
  return drawing;
}

TEST(DrawBeard, ABeardHidesTheChinAndNotTheMouth) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const PartDrawing drawing = DrawnBeard(&HairStyles::beard, seed);
    EXPECT_FALSE(drawing.At(faces::FacePoint::kChin)) << seed;
    EXPECT_EQ(drawing.NumLines(faces::LineLabel::kInnerMouth), 1) << seed;
    EXPECT_GE(drawing.NumLines(faces::LineLabel::kHair), 2);
  }
}

TEST(DrawBeard, MoustachesAndStubbleHideNothing) {
  for (double HairStyles::*kind : {&HairStyles::moustache, &HairStyles::stubble}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const PartDrawing drawing = DrawnBeard(kind, seed);
      EXPECT_TRUE(drawing.At(faces::FacePoint::kChin));
      EXPECT_GE(drawing.NumLines(faces::LineLabel::kHair), 2);
    }
  }
}

TEST(DrawBeard, NothingWithoutAMouth) {
  PartDrawing drawing;
  drawing.styles.hair.beard = drawing.styles.hair.moustache = 1;
  DrawBeard(drawing.context());
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

}  // namespace
}  // namespace daumier::datasets
