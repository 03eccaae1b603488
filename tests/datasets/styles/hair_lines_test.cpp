#include "datasets/styles/hair_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using testing::PartDrawing;

constexpr HairStyles kNoHair = {
    .none = 0, .short_cut = 0, .long_cut = 0, .swept = 0, .spiky = 0, .strokes = 0, .curls = 0, .tails = 0, .bun = 0};

TEST(DrawHair, EveryKindHasItsLinesAndHidesTheCrown) {
  const std::vector<double HairStyles::*> kinds = {&HairStyles::short_cut, &HairStyles::long_cut, &HairStyles::swept,
                                                   &HairStyles::spiky,     &HairStyles::tails,    &HairStyles::bun,
                                                   &HairStyles::curls};
  for (double HairStyles::*kind : kinds) {
    for (uint64_t seed = 0; seed < 10; ++seed) {
      PartDrawing drawing{.rng = Rng(seed)};
      drawing.styles.hair = kNoHair;
      drawing.styles.hair.*kind = 1;
      const HairChoice choice = ChooseHair(drawing.context());
      drawing.sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, drawing.shape.skull);
      drawing.sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, {{120, 165}, {130, 165}});
      DrawHair(drawing.context(), choice);
      testing::ExpectWholeLines(drawing.sheet);
      double shown = 0;
      for (const StyledLine& line : drawing.sheet.lines)
        if (line.labels.front() == faces::LineLabel::kSilhouette) shown += LengthOf(line.points);
      EXPECT_LT(shown, 0.45 * LengthOf(drawing.shape.skull)) << "hair leaves the skull bare";
      EXPECT_EQ(drawing.NumLines(faces::LineLabel::kInnerMouth), 1) << "hair hides the mouth";
      EXPECT_GE(drawing.NumLines(faces::LineLabel::kHair), 1);
    }
  }
}

TEST(DrawHair, StrokesAndFewLinesHideNothing) {
  for (double HairStyles::*kind : {&HairStyles::strokes, &HairStyles::few}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      PartDrawing drawing{.rng = Rng(seed)};
      drawing.styles.hair = kNoHair;
      drawing.styles.hair.*kind = 1;
      const HairChoice choice = ChooseHair(drawing.context());
      drawing.sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, {{128, 70}, {128, 66}});
      DrawHair(drawing.context(), choice);
      testing::ExpectWholeLines(drawing.sheet);
      EXPECT_EQ(drawing.NumLines(faces::LineLabel::kSilhouette), 1);
      EXPECT_GE(drawing.NumLines(faces::LineLabel::kHair), 1);
    }
  }
}

TEST(DrawHair, LongHairHidesTheEars) {
  PartDrawing drawing;
  drawing.styles.hair = kNoHair;
  drawing.styles.hair.long_cut = 1;
  EXPECT_TRUE(ChooseHair(drawing.context()).hides_ears);
  drawing.styles.hair = kNoHair;
  drawing.styles.hair.none = 1;
  drawing.styles.head.open_top = 1;
  const HairChoice bald = ChooseHair(drawing.context());
  EXPECT_FALSE(bald.hides_ears);
  EXPECT_EQ(bald.border, HeadBorder::kOpenTop);
  DrawHair(drawing.context(), bald);
  EXPECT_TRUE(drawing.sheet.lines.empty());
}

TEST(DrawHair, BlackHairIsAnArea) {
  PartDrawing drawing;
  drawing.styles.hair = kNoHair;
  drawing.styles.hair.short_cut = drawing.styles.hair.solid = 1;
  DrawHair(drawing.context(), ChooseHair(drawing.context()));
  ASSERT_EQ(drawing.sheet.lines.size(), 1u);
  EXPECT_TRUE(drawing.sheet.lines[0].filled);
}

}  // namespace
}  // namespace daumier::datasets
