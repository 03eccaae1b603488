#include "geometry/registration_quality.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace daumier::geometry {
namespace {

std::vector<int> AllOf(const TriangleMesh& mesh) {
  std::vector<int> all(mesh.vertices.rows());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

TEST(RegistrationQuality, SpreadIsLinearBetweenRanks) {
  const DistanceSpread spread = SpreadOf(std::vector<double>{4, 1, 2, 3}).value();
  EXPECT_DOUBLE_EQ(spread.mean, 2.5);
  EXPECT_DOUBLE_EQ(spread.median, 2.5);
  EXPECT_DOUBLE_EQ(spread.p95, 3.85);
  EXPECT_FALSE(SpreadOf({})) << "a distance over nothing is not 0";
}

TEST(RegistrationQuality, ASphereOnItselfIsPerfect) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const auto quality = MeasureRegistration(sphere, sphere.vertices, AllOf(sphere), SurfaceMatcher(sphere), {});
  EXPECT_NEAR(quality.template_to_target.value().p95, 0, 1e-12);
  EXPECT_NEAR(quality.target_to_template.p95, 0, 1e-12);
  EXPECT_NEAR(quality.coverage, 1, 1e-12);
  EXPECT_NEAR(quality.target_reached, 1, 1e-12);
  EXPECT_EQ(quality.flipped_region + quality.self_intersections + quality.self_intersections_at_rest, 0);
}

TEST(RegistrationQuality, ASheetOverHalfOfAnother) {
  // The target covers x in 0 .. 1 at height 0; the template x in 0.5 .. 1.5 at height 0.1.
  const TriangleMesh target = testing::FlatSheet(20);
  TriangleMesh mesh = target;
  mesh.vertices.rowwise() += Eigen::RowVector3d(0.5, 0, 0.1);
  const auto quality = MeasureRegistration(mesh, mesh.vertices, AllOf(mesh), SurfaceMatcher(target), {.distance = 0.2});
  EXPECT_NEAR(quality.template_to_target.value().mean, 0.1, 1e-9);
  EXPECT_NEAR(quality.coverage, 0.45, 0.03);        // Half of it, without the rim of the target.
  EXPECT_NEAR(quality.target_reached, 0.67, 0.04);  // Half of it, and 0.17 next to it.
  EXPECT_TRUE(std::isnan(quality.distances[20]));
  EXPECT_EQ(quality.flipped_region, 0);
}

TEST(RegistrationQuality, NothingInReachHasNoDistance) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  TriangleMesh far = sphere;
  far.vertices.array() += 50;
  const auto quality = MeasureRegistration(sphere, sphere.vertices, AllOf(sphere), SurfaceMatcher(far), {});
  EXPECT_FALSE(quality.template_to_target);
  EXPECT_EQ(quality.coverage, 0);
  EXPECT_GT(quality.target_to_template.mean, 50);
}

TEST(RegistrationQuality, VerticesWithoutTrianglesAreNotMeasured) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  TriangleMesh target = sphere;
  target.vertices.conservativeResize(sphere.vertices.rows() + 1, 3);
  target.vertices.bottomRows(1) << 1000, 2000, 3000;
  const auto quality = MeasureRegistration(sphere, sphere.vertices, AllOf(sphere), SurfaceMatcher(target), {});
  EXPECT_NEAR(quality.target_to_template.p95, 0, 1e-12);
  EXPECT_NEAR(quality.target_to_template.mean, 0, 1e-12);
  EXPECT_EQ(quality.num_region_triangles, sphere.triangles.rows());
}

TEST(RegistrationQuality, CountsFlipsOfTheRegion) {
  const TriangleMesh sheet = testing::FlatSheet(4);
  Points folded = sheet.vertices;
  folded(12, 0) += 0.3;  // The vertex in the middle, over its right neighbour.
  const SurfaceMatcher target(sheet);
  EXPECT_GT(MeasureRegistration(sheet, folded, AllOf(sheet), target, {}).flipped_region, 0);
  EXPECT_EQ(MeasureRegistration(sheet, folded, {0, 1, 5, 6}, target, {}).flipped_region, 0);
  testing::ExpectError([&] { MeasureRegistration(sheet, folded, {}, target, {}); }, "has no vertex");
  testing::ExpectError([&] { MeasureRegistration(sheet, Points(3, 3), {0}, target, {}); }, "3 registered vertices");
}

}  // namespace
}  // namespace daumier::geometry
