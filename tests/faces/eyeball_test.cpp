#include "faces/eyeball.h"

#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace daumier::faces {
namespace {

constexpr int kLid = 24;
constexpr double kEyeWidth = 2.5;

/// Lids on a sphere of radius 0.6 kEyeWidth about `centre`: an almond as wide as 2.5 with half the height `half`; then
/// rings of skin around it, on the same sphere but farther out by 2 % and in front.
geometry::Points Lids(const geometry::Vector3& centre, double half) {
  const double radius = 0.6 * kEyeWidth;
  geometry::Points points(3 * kLid, 3);
  for (int ring = 0; ring < 3; ++ring) {
    for (int i = 0; i < kLid; ++i) {
      const double angle = 2 * std::numbers::pi * i / kLid, wider = 1 + 0.08 * ring;
      const double x = wider * 0.5 * kEyeWidth * std::cos(angle), y = (half + 0.1 * ring) * std::sin(angle);
      const double z = std::sqrt(std::max(0.0, std::pow(radius * (1 + 0.02 * ring), 2) - x * x - y * y));
      points.row(ring * kLid + i) = (centre + geometry::Vector3(x, y, z)).transpose();
    }
  }
  return points;
}

std::vector<int> LidLoop() {
  std::vector<int> loop(kLid);
  for (int i = 0; i < kLid; ++i) loop[size_t(i)] = i;
  return loop;
}

/// The strips between the rings of Lids.
geometry::Triangles SkinTriangles() {
  geometry::Triangles triangles(4 * kLid, 3);
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < kLid; ++i) {
      const int a = ring * kLid + i, b = ring * kLid + (i + 1) % kLid;
      triangles.row(2 * a) << a, a + kLid, b + kLid;
      triangles.row(2 * a + 1) << a, b + kLid, b;
    }
  }
  return triangles;
}

void ExpectBehind(const Eyeball& eyeball, const geometry::Points& skin) {
  for (const auto& row : skin.rowwise()) {
    const geometry::Vector3 p = row.transpose() - eyeball.centre;
    EXPECT_GT(p.z(), eyeball.Front(p.x(), p.y()));
  }
}

TEST(EyeballFit, FindsTheBallUnderLidsOfIt) {
  const geometry::Vector3 centre(3, 4, 8);
  const geometry::Points lids = Lids(centre, 0.6);
  const Eyeball eyeball = EyeballFit({lids, SkinTriangles()}, LidLoop()).Fit(lids);
  EXPECT_LT((eyeball.centre - centre).head<2>().norm(), 0.05);
  EXPECT_NEAR(eyeball.centre.z(), centre.z(), 0.15) << "a little behind, for the cornea and by its clearance";
  EXPECT_NEAR(eyeball.radii.x(), 1.5, 0.01);
  EXPECT_NEAR(eyeball.radii.y(), 1.5, 0.05);
  ExpectBehind(eyeball, lids);
}

TEST(EyeballFit, StaysWhereLidsClose) {
  const geometry::Points open = Lids({3, 4, 8}, 0.6);
  geometry::Points closed = open;
  for (int i = 1; i < kLid / 2; ++i) closed.row(i) = open.row(kLid - i);  // The upper lid on the lower one.
  const EyeballFit fit({open, SkinTriangles()}, LidLoop());
  const Eyeball before = fit.Fit(open), after = fit.Fit(closed);
  EXPECT_LT((before.centre - after.centre).head<2>().norm(), 0.05);
  EXPECT_NEAR(before.centre.z(), after.centre.z(), 0.25) << "the skin of a closed lid is stretched flat";
  EXPECT_NEAR(before.radii.y(), after.radii.y(), 0.05);
  ExpectBehind(after, closed);
}

TEST(EyeballFit, GrowsWithATallOpeningAndScalesWithAFace) {
  const geometry::Points neutral = Lids({3, 4, 8}, 0.6), tall = Lids({3, 4, 8}, 1.4);
  const EyeballFit fit({neutral, SkinTriangles()}, LidLoop());
  const Eyeball eyeball = fit.Fit(tall);
  EXPECT_GT(eyeball.radii.y(), 1.4 + 0.1);
  ExpectBehind(eyeball, tall);
  const Eyeball once = fit.Fit(neutral), twice = fit.Fit(2 * neutral);
  EXPECT_LT((2 * once.centre - twice.centre).norm(), 1e-9);
  EXPECT_NEAR(2 * once.iris_radius, twice.iris_radius, 1e-12);
}

TEST(EyeballFit, OfAnOpeningMuchTallerThanWideIsFinite) {
  geometry::Points points(8, 3);
  points << 0, 0, 1, 0.1, 5, 1, 0.2, 9, 1, 0.3, 5, 1, 0.4, 0, 1, 0.3, -5, 1, 0.2, -9, 1, 0.1, -5, 1;
  const Eyeball eyeball = EyeballFit({points, {}}, {0, 1, 2, 3, 4, 5, 6, 7}).Fit(points);
  EXPECT_TRUE(eyeball.centre.allFinite());
  EXPECT_TRUE(EyeballPoints(eyeball).allFinite());
}

TEST(EyeballFit, RefusesALoopThatIsNoOpening) {
  const geometry::Points points = geometry::Points::Zero(5, 3);
  testing::ExpectError([&] { EyeballFit({points, {}}, {0, 1, 2}); }, "has 3 vertices");
  testing::ExpectError([&] { EyeballFit({points, {}}, {0, 1, 2, 3}); }, "lie in one point");
}

TEST(EyeballMesh, IsAClosedBallWithARoundIris) {
  const EyeballMesh& topology = EyeballTopology();
  geometry::Triangles triangles(Eigen::Index(topology.triangles.size()), 3);
  for (size_t t = 0; t < topology.triangles.size(); ++t)
    triangles.row(Eigen::Index(t)) = topology.triangles[t].transpose();
  ASSERT_EQ(topology.materials.size(), topology.triangles.size());
  EXPECT_NO_THROW(geometry::CheckManifold(triangles, NumEyeballVertices()));
  EXPECT_TRUE(geometry::BoundaryLoops(triangles, NumEyeballVertices()).empty());
  EXPECT_EQ(geometry::EulerCharacteristic(triangles), 2);

  const Eyeball eyeball{{1, 2, 3}, {1.5, 2.5, 1.5}, 0.5, 0.1};
  const geometry::TriangleMesh mesh{EyeballPoints(eyeball), triangles};
  const geometry::Points centred = mesh.vertices.rowwise() - eyeball.centre.transpose();
  double least = 10, most = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    const geometry::Vector3 middle =
        (centred.row(triangles(t, 0)) + centred.row(triangles(t, 1)) + centred.row(triangles(t, 2))).transpose() / 3;
    EXPECT_GT(geometry::AreaNormals(mesh).row(t).dot(middle.transpose()), 0) << "outwards";
    if (topology.materials[size_t(t)] != HeadMaterial::kLimbus) continue;
    EXPECT_GT(middle.z(), 0) << "it looks to +z";
    for (int k = 0; k < 3; ++k) most = std::max(most, centred.row(triangles(t, k)).head<2>().norm());
    for (int k = 0; k < 3; ++k) least = std::min(least, centred.row(triangles(t, k)).head<2>().norm());
  }
  EXPECT_NEAR(most, 0.5, 0.03) << "round in the plane of x and y";
  EXPECT_NEAR(least, 0.88 * 0.5, 0.03);
  EXPECT_NEAR(centred(0, 2), 1.6, 1e-12) << "the cornea";
  const auto uv = EyeballUv();
  EXPECT_EQ(uv.rows(), NumEyeballVertices());
  EXPECT_TRUE((uv.array() >= 0 && uv.array() <= 1).all());
}

}  // namespace
}  // namespace daumier::faces
