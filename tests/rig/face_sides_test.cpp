#include "rig/face_sides.h"

#include "tests/rig/slit_sheet.h"

#include <gtest/gtest.h>

namespace daumier::rig {
namespace {

TEST(FaceSide, HasAnOpposite) {
  EXPECT_EQ(UpperSide(FaceSlit::kRightEye), FaceSide::kRightUpperLid);
  EXPECT_EQ(LowerSide(FaceSlit::kLeftEye), FaceSide::kLeftLowerLid);
  EXPECT_EQ(OppositeSide(FaceSide::kNone), FaceSide::kNone);
  for (int s = 0; s < kNumFaceSlits; ++s) {
    EXPECT_EQ(OppositeSide(UpperSide(FaceSlit(s))), LowerSide(FaceSlit(s)));
    EXPECT_EQ(OppositeSide(LowerSide(FaceSlit(s))), UpperSide(FaceSlit(s)));
  }
}

TEST(SidesOfTemplate, AreThoseOfTheNearerEdgeWithinReach) {
  const testing::SlitSheet sheet = testing::MakeSlitSheet(16);
  const std::vector<FaceSide> sides = SidesOfTemplate(sheet.mesh, sheet.slits);
  const SeamEdges& edges = sheet.slits[0];
  for (size_t i = 1; i + 1 < edges.upper.size(); ++i) {
    EXPECT_EQ(sides[size_t(edges.upper[i])], FaceSide::kUpperLip);
    EXPECT_EQ(sides[size_t(edges.lower[i])], FaceSide::kLowerLip) << "at the same place";
  }
  EXPECT_EQ(sides[size_t(edges.upper.front())], FaceSide::kNone) << "a corner";
  int num_upper = 0;
  for (Eigen::Index v = 0; v < sheet.mesh.vertices.rows(); ++v) {
    const double y = sheet.mesh.vertices(v, 1), x = sheet.mesh.vertices(v, 0);
    const FaceSide side = sides[size_t(v)];
    if (side == FaceSide::kUpperLip) {
      ++num_upper;
      EXPECT_GE(y, 0.5);
    }
    if (side == FaceSide::kLowerLip) {
      EXPECT_LE(y, 0.5);
    }
    if (x < 0.25 || std::abs(y - 0.5) > 0.5 * kSideReach + 1e-9) {
      EXPECT_EQ(side, FaceSide::kNone);
    }
  }
  EXPECT_GT(num_upper, 20);
}

}  // namespace
}  // namespace daumier::rig
