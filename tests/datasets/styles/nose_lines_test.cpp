#include "datasets/styles/nose_lines.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

using enum faces::FacePoint;
using testing::PartDrawing;

constexpr NoseStyles kNoNose = {
    .one_side = 0, .both_sides = 0, .wings = 0, .nostrils = 0, .hook = 0, .bridge = 0, .round = 0, .dot = 0, .none = 0};

PartDrawing DrawnNose(double NoseStyles::*kind, uint64_t seed, FaceShape shape = testing::PlainFaceShape()) {
  PartDrawing drawing{.shape = std::move(shape), .rng = Rng(seed)};
  drawing.styles.nose = kNoNose;
  drawing.styles.nose.*kind = 1;
  DrawNose(drawing.context());
  testing::ExpectWholeLines(drawing.sheet);
  return drawing;
}

TEST(DrawNose, TheBottomIsWhereItIsDrawn) {
  for (double NoseStyles::*kind : {&NoseStyles::one_side, &NoseStyles::hook, &NoseStyles::round, &NoseStyles::dot}) {
    for (uint64_t seed = 0; seed < 20; ++seed) {
      const PartDrawing drawing = DrawnNose(kind, seed);
      ASSERT_TRUE(drawing.At(kNoseBottom));
      EXPECT_LT((*drawing.At(kNoseBottom) - Eigen::Vector2d(128, 148)).norm(), 8);
      EXPECT_EQ(drawing.NumLines(faces::LineLabel::kNose), int(drawing.sheet.lines.size()));
    }
  }
}

TEST(DrawNose, WingsAreTheOutermostPoints) {
  for (double NoseStyles::*kind : {&NoseStyles::both_sides, &NoseStyles::wings}) {
    const PartDrawing drawing = DrawnNose(kind, 4);
    ASSERT_TRUE(drawing.At(kNoseWingRight) && drawing.At(kNoseWingLeft));
    EXPECT_NEAR(drawing.At(kNoseWingRight)->x(), 115, 1.0);
    EXPECT_NEAR(drawing.At(kNoseWingLeft)->x(), 141, 1.0);
  }
}

TEST(DrawNose, NostrilsAndABridgeAloneCarryNoPoint) {
  for (double NoseStyles::*kind : {&NoseStyles::nostrils, &NoseStyles::bridge}) {
    const PartDrawing drawing = DrawnNose(kind, 7);
    EXPECT_FALSE(drawing.sheet.lines.empty());
    EXPECT_FALSE(drawing.At(kNoseBottom) || drawing.At(kNoseWingRight) || drawing.At(kNoseWingLeft));
  }
}

TEST(DrawNose, ATurnedFaceShowsTheContourOfTheFarSide) {
  FaceShape shape = testing::PlainFaceShape();
  shape.view = faces::DrawnView::kThreeQuarterLeft;
  shape.nose.bridges[0] = shape.nose.wings[0] = {};
  for (int i = 0; i < 16; ++i) shape.nose.contour.push_back({112.0 - i % 2, 114 + 2.0 * i});
  const PartDrawing drawing = DrawnNose(&NoseStyles::one_side, 1, shape);
  EXPECT_NEAR(drawing.sheet.lines.front().points.back().x(), 111.5, 1);
  EXPECT_FALSE(drawing.At(kNoseWingRight));
}

}  // namespace
}  // namespace daumier::datasets
