#include "datasets/styles/hair_mass.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

TEST(HairMass, ShortHairCoversTheCrownAndLeavesTheFace) {
  const FaceShape shape = testing::PlainFaceShape();
  for (uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed);
    const HairPlan plan = DrawHairPlan(HairLength::kShort, Hairline::kRound, rng);
    const Polyline mass = MakeHairMass(shape, plan, rng).polygon();
    EXPECT_TRUE(IsInside(mass, {128, 67})) << seed;
    for (const Eigen::Vector2d& point : {Eigen::Vector2d(106, 120), {150, 120}, {128, 146}, {128, 165}, {128, 195}})
      EXPECT_FALSE(IsInside(mass, point)) << seed;
  }
}

TEST(HairMass, LongHairHangsDownAtBothSides) {
  const FaceShape shape = testing::PlainFaceShape();
  for (uint64_t seed = 0; seed < 30; ++seed) {
    Rng rng(seed);
    HairPlan plan = DrawHairPlan(HairLength::kLong, Hairline::kMiddleParting, rng);
    plan.fall = 1.5;
    const HairMass mass = MakeHairMass(shape, plan, rng);
    const double bottom = shape.eyes_middle.y() + plan.fall * shape.unit;
    EXPECT_NEAR(mass.outer.front().y(), bottom, 0.2 * shape.unit) << seed;
    EXPECT_NEAR(mass.outer.back().y(), bottom, 0.2 * shape.unit) << seed;
    EXPECT_LT(mass.outer.front().x(), 128 - 30);
    EXPECT_GT(mass.outer.back().x(), 128 + 30);
    EXPECT_FALSE(IsInside(mass.polygon(), shape.mouth_middle())) << seed;
  }
}

TEST(HairMass, BordersRunFromRightToLeft) {
  for (const Hairline hairline : {Hairline::kRound, Hairline::kFringe, Hairline::kMiddleParting, Hairline::kSideParting,
                                  Hairline::kPeak, Hairline::kSwept, Hairline::kSpiky}) {
    Rng rng(3);
    const HairMass mass = MakeHairMass(testing::PlainFaceShape(), DrawHairPlan(HairLength::kShort, hairline, rng), rng);
    for (const Polyline* line : {&mass.outer, &mass.inner}) {
      EXPECT_LT(line->front().x(), line->back().x());
      for (const Eigen::Vector2d& point : *line) EXPECT_TRUE(point.allFinite());
    }
  }
}

TEST(HairMass, SpikesStandOut) {
  Rng rng(3);
  HairPlan plan = DrawHairPlan(HairLength::kShort, Hairline::kRound, rng);
  plan.thickness = plan.side = 0.05;
  plan.spikes = 0.4;
  double highest = 1e9;
  for (const Eigen::Vector2d& point : MakeHairMass(testing::PlainFaceShape(), plan, rng).outer)
    highest = std::min(highest, point.y());
  EXPECT_LT(highest, 120 - 55 * 1.2);
}

TEST(HairMass, OfAProfileLiesBehindTheForehead) {
  FaceShape shape = testing::PlainFaceShape();
  shape.view = faces::DrawnView::kProfile;
  shape.outline = Resampled({{165, 90}, {170, 115}, {185, 140}, {170, 150}, {172, 180}, {150, 195}}, 49);
  shape.skull = Smooth({{90, 170}, {75, 120}, {90, 80}, {130, 65}, {165, 90}}, 41);
  shape.ears = {};
  shape.ears[0].outer = EllipseArc({115, 130}, 8, 14, -90, 90, 21);
  for (uint64_t seed = 0; seed < 10; ++seed) {
    Rng rng(seed);
    const HairMass mass = MakeHairMass(shape, DrawHairPlan(HairLength::kShort, Hairline::kRound, rng), rng);
    EXPECT_TRUE(IsInside(mass.polygon(), {115, 78})) << seed;
    EXPECT_FALSE(IsInside(mass.polygon(), {160, 130})) << seed;
  }
}

}  // namespace
}  // namespace daumier::datasets
