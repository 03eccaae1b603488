#include "rig/material_colours.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(MaterialColour, IsOneOfItsOwnForEachMaterial) {
  for (const auto& a : faces::kHeadMaterials) {
    const Eigen::Vector3f colour = MaterialColour(a.material);
    EXPECT_GE(colour.minCoeff(), 0.05f) << a.name;
    EXPECT_LE(colour.maxCoeff(), 0.95f) << a.name;
    for (const auto& b : faces::kHeadMaterials)
      if (a.material != b.material) {
        EXPECT_FALSE(colour.isApprox(MaterialColour(b.material))) << a.name << b.name;
      }
  }
}

}  // namespace
}  // namespace daumier::rig
