#include "datasets/styles/proportions.h"

#include "tests/support/expect_error.h"
#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

double LargestMove(FaceShape a, FaceShape b) {
  std::vector<Eigen::Vector2d> from, to;
  ForEachLine(a, [&](Polyline& line) { from.insert(from.end(), line.begin(), line.end()); });
  ForEachLine(b, [&](Polyline& line) { to.insert(to.end(), line.begin(), line.end()); });
  EXPECT_EQ(from.size(), to.size());
  double largest = 0;
  for (size_t i = 0; i < std::min(from.size(), to.size()); ++i) largest = std::max(largest, (from[i] - to[i]).norm());
  return largest;
}

TEST(Proportions, WithoutErrorsTheShapeStays) {
  Rng rng(1);
  const FaceShape shape = testing::PlainFaceShape();
  EXPECT_LT(LargestMove(shape, WithErrors(shape, 0, DrawingCharacter::kCareful, rng)), 1e-9);
  const double moved = LargestMove(shape, WithErrors(shape, 0.06, DrawingCharacter::kCareful, rng));
  EXPECT_GT(moved, 0.5);
  EXPECT_LT(moved, 0.5 * shape.unit);
}

TEST(Proportions, DoodlesKeepTheirPartsInTheHead) {
  for (uint64_t seed = 0; seed < 60; ++seed) {
    Rng rng(seed);
    FaceShape shape = seed % 2 == 0 ? testing::PlainFaceShape() : testing::OpenMouthShape();
    const FaceShape doodle = DoodleShape(shape, 1, rng);
    const Polyline head = doodle.head();
    for (const EyeShape& eye : doodle.eyes)
      EXPECT_TRUE(IsInside(head, (eye.upper.front() + eye.upper.back()) / 2)) << seed;
    EXPECT_TRUE(IsInside(head, doodle.mouth_middle())) << seed;
    EXPECT_LT(doodle.eyes_middle.y(), doodle.mouth_middle().y()) << seed;
    EXPECT_LT(doodle.eyes[0].upper.front().x(), doodle.eyes[1].upper.front().x());
    EXPECT_EQ(doodle.mouth.is_open, shape.mouth.is_open);
    const auto m = size_t(doodle.mouth.middle);
    const double gap = doodle.mouth.inner_bottom[m].y() - doodle.mouth.inner_top[m].y();
    if (shape.mouth.is_open) {
      EXPECT_GT(gap, 1) << seed;
    } else {
      EXPECT_LT(std::abs(gap), 1e-9) << seed;
    }
  }
}

TEST(Proportions, ADoodleOfNoAmountHasThePlacesOfTheFace) {
  const FaceShape shape = testing::PlainFaceShape();
  Rng rng(4);
  const FaceShape doodle = DoodleShape(shape, 0, rng);
  EXPECT_LT((doodle.eyes_middle - shape.eyes_middle).norm(), 1);
  EXPECT_LT((doodle.mouth_middle() - shape.mouth_middle()).norm(), 2);
  EXPECT_LT((doodle.outline[24] - shape.outline[24]).norm(), 1);
  EXPECT_LT((doodle.eyes[0].upper.front() - shape.eyes[0].upper.front()).norm(), 1);
}

TEST(Proportions, TurnedFacesAreNoDoodles) {
  FaceShape shape = testing::PlainFaceShape();
  shape.view = faces::DrawnView::kThreeQuarterLeft;
  Rng rng(1);
  testing::ExpectError([&] { DoodleShape(shape, 1, rng); }, "three-quarter-left");
}

TEST(SmoothBend, IsSmallAndSmooth) {
  const FaceShape shape = testing::PlainFaceShape();
  Rng rng(2);
  const auto bend = SmoothBend(shape, 0.02, rng);
  double largest = 0;
  for (const Eigen::Vector2d& point : shape.head()) {
    largest = std::max(largest, (bend(point) - point).norm());
    const Eigen::Vector2d step(0.01, 0.01);
    EXPECT_LT((bend(point + step) - bend(point) - step).norm(), 0.01) << "it stretches by less than 70 %";
  }
  EXPECT_GT(largest, 0.2);
  EXPECT_LT(largest, 0.3 * 65);
  Rng still(2);
  EXPECT_EQ(SmoothBend(shape, 0, still)(Eigen::Vector2d(50, 60)), Eigen::Vector2d(50, 60));
}

}  // namespace
}  // namespace daumier::datasets
