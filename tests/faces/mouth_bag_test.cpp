#include "faces/mouth_bag.h"

#include "faces/hole_closure.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

TEST(MouthBag, GoesStraightBackAndNarrows) {
  geometry::Points lips(4, 3);
  lips << -2, 0, 1, 0, -1, 2, 2, 0, 1, 0, 1, 2;
  const geometry::Points bag = MouthBagPoints(lips, 4);
  ASSERT_EQ(bag.rows(), kMouthRings * 4 + 1);
  double last_z = 1.5, last_x = 2;
  for (int ring = 0; ring < kMouthRings; ++ring) {
    const auto points = bag.middleRows(4 * ring, 4);
    EXPECT_LT(points.col(2).mean(), last_z);
    EXPECT_LT(points.col(0).maxCoeff(), last_x);
    EXPECT_TRUE((points.col(2).array() < lips.col(2).array()).all()) << "behind the lips, ring " << ring;
    last_z = points.col(2).mean();
    last_x = points.col(0).maxCoeff();
  }
  EXPECT_NEAR(bag(bag.rows() - 1, 2), 1.5 - 0.7 * 4, 1e-12);
}

TEST(MouthBag, HasAMaterialForEachTriangleAndDarkensToTheEnd) {
  const auto materials = MouthBagMaterials(5);
  EXPECT_EQ(materials.size(), (HoleClosure{{0, 1, 2, 3, 4}, 5, kMouthRings}.Triangles().size()));
  EXPECT_EQ(materials.front(), HeadMaterial::kInnerLip);
  EXPECT_EQ(materials.back(), HeadMaterial::kThroat);
  EXPECT_TRUE(std::is_sorted(materials.begin(), materials.end()));
}

}  // namespace
}  // namespace daumier::faces
