#include "rig/template_match.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

class TemplateMatches : public ::testing::Test {
 protected:
  testing::SlitSheet sheet_ = testing::MakeSlitSheet(16);
  TemplateMatch match_{sheet_.mesh, sheet_.slits, SidesOfTemplate(sheet_.mesh, sheet_.slits)};
  const geometry::Vector3 front_ = geometry::Vector3::UnitZ();

  std::optional<geometry::SurfacePoint> WithoutLower(const geometry::Vector3& point, double reach) const {
    return match_.Nearest(point, front_, reach, [](FaceSide side) { return side != FaceSide::kLowerLip; });
  }
};

TEST_F(TemplateMatches, AreTheNearestPointsOfAnAllowedSide) {
  const geometry::Vector3 below(0.5, 0.46, 0.01);
  const auto any = match_.Nearest(below, front_, 0.5, [](FaceSide) { return true; });
  ASSERT_TRUE(any);
  EXPECT_NEAR(any->distance, 0.01, 1e-12);
  EXPECT_EQ(match_.side(any->triangle), FaceSide::kLowerLip);
  const auto upper = WithoutLower(below, 0.5);
  ASSERT_TRUE(upper);
  EXPECT_NEAR(upper->position.y(), 0.5, 1e-12) << "the upper edge, across the slit";
  EXPECT_EQ(match_.side(upper->triangle), FaceSide::kUpperLip);
}

TEST_F(TemplateMatches, FaceAsThePlaceDoesAndLieWithinReach) {
  const geometry::Vector3 below(0.5, 0.46, 0.01);
  EXPECT_FALSE(WithoutLower(below, 0.03));
  EXPECT_FALSE(match_.Nearest(below, -front_, 0.5, [](FaceSide) { return true; }));
  EXPECT_NEAR(match_.NearestOfAll({0.5, 0.5, 7}).distance, 7, 1e-12);
}

}  // namespace
}  // namespace daumier::rig
