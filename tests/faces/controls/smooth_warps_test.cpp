#include "faces/controls/smooth_warps.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::faces {
namespace {

TEST(SmoothWarps, Are57PolynomialsOfDegreeOneToThree) {
  const FaceTemplate face = testing::SyntheticFace();
  const auto warps = SmoothWarps(face);
  ASSERT_EQ(warps.size(), 57u);
  std::set<std::string> names;
  const double span = EyeSpan(face);
  for (const GivenControl& warp : warps) {
    EXPECT_TRUE(names.insert(warp.name).second) << warp.name;
    EXPECT_EQ(warp.group, "warp");
    EXPECT_LE(warp.displacement.cwiseAbs().maxCoeff(), 0.03 * span + 1e-12) << "Legendre polynomials are at most 1";
  }
  // By hand: P_1 along y of the bounding box, degree 1, moves along z.
  const auto tilt = std::find_if(warps.begin(), warps.end(), [](const auto& warp) { return warp.name == "warp_z_y"; });
  ASSERT_NE(tilt, warps.end());
  const auto y = face.neutral.col(1);
  for (int v = 0; v < face.num_vertices(); v += 13) {
    const double t = 2 * (y[v] - y.minCoeff()) / (y.maxCoeff() - y.minCoeff()) - 1;
    EXPECT_NEAR(tilt->displacement(v, 2), 0.03 * span * t, 1e-12);
    EXPECT_EQ(tilt->displacement(v, 0), 0);
  }
}

TEST(SmoothWarps, KnowWhichOnesASymmetricFaceAllows) {
  const FaceTemplate face = testing::SyntheticFace();
  for (const GivenControl& warp : SmoothWarps(face)) {
    geometry::Points mirrored = warp.displacement(face.annotation.mirror, Eigen::all);
    mirrored.col(0) *= -1;
    const bool is_symmetric = (mirrored - warp.displacement).cwiseAbs().maxCoeff() < 1e-9;
    EXPECT_EQ(is_symmetric, warp.sides == FaceControl::Sides::kMiddle) << warp.name;
  }
}

}  // namespace
}  // namespace daumier::faces
