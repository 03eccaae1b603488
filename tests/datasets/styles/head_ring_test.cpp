#include "datasets/styles/head_ring.h"

#include "tests/support/plain_face_shape.h"

namespace daumier::datasets {
namespace {

TEST(HeadRing, RadiiAreThoseOfTheEllipse) {
  const HeadRing ring(testing::PlainFaceShape());
  EXPECT_LT((ring.middle() - Eigen::Vector2d(128, 120)).norm(), 1e-6);
  EXPECT_NEAR(ring.Radius(0), 55, 0.2);    // From y = 120 up to 65.
  EXPECT_NEAR(ring.Radius(180), 75, 0.2);  // Down to 195.
  EXPECT_NEAR(ring.Radius(-180), ring.Radius(180), 1e-12);
  // At the height of the eyes: 50 sqrt(1 - (10 / 65)^2).
  EXPECT_NEAR(ring.Radius(90), 49.4, 0.3);
  EXPECT_NEAR(ring.Radius(-90), 49.4, 0.3);
}

TEST(HeadRing, AtAndItsInverseAgree) {
  const HeadRing ring(testing::PlainFaceShape());
  for (const double angle : {-150.0, -60.0, 0.0, 35.0, 120.0}) {
    const Eigen::Vector2d point = ring.At(angle, 0.7);
    EXPECT_NEAR(ring.AngleOf(point), angle, 1e-9);
    EXPECT_NEAR(ring.ShareOf(point), 0.7, 1e-9);
  }
  EXPECT_GT(ring.At(90, 1).x(), 128) << "positive angles turn to the right";
  const Polyline arc = ring.Arc(-30, 30, 5, [](double t) { return 1 + t; });
  EXPECT_LT((arc[0] - ring.At(-30, 1)).norm() + (arc[4] - ring.At(30, 2)).norm(), 1e-9);
}

}  // namespace
}  // namespace daumier::datasets
