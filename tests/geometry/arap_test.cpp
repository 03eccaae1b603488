#include "geometry/arap.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

namespace daumier::testing {
namespace {

/// A bar of 2 x 2 x 9 cells, open nowhere: the surface of a box from (0, 0, 0) to (2, 2, 9).
geometry::TriangleMesh ArapBar() {
  geometry::TriangleMesh bar;
  constexpr int kRings = 10, kAround = 8;
  const double square[kAround][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  bar.vertices.resize(kRings * kAround + 2, 3);
  for (int r = 0; r < kRings; ++r)
    for (int a = 0; a < kAround; ++a) bar.vertices.row(r * kAround + a) << square[a][0], square[a][1], r;
  bar.vertices.row(kRings * kAround) << 1, 1, 0;
  bar.vertices.row(kRings * kAround + 1) << 1, 1, kRings - 1;
  std::vector<std::array<int, 3>> triangles;
  for (int r = 0; r + 1 < kRings; ++r) {
    for (int a = 0; a < kAround; ++a) {
      const int p = r * kAround + a, q = r * kAround + (a + 1) % kAround;
      triangles.push_back({p, q, q + kAround});
      triangles.push_back({p, q + kAround, p + kAround});
    }
  }
  for (int a = 0; a < kAround; ++a) {
    triangles.push_back({kRings * kAround, (a + 1) % kAround, a});
    const int top = (kRings - 1) * kAround;
    triangles.push_back({kRings * kAround + 1, top + a, top + (a + 1) % kAround});
  }
  bar.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (size_t t = 0; t < triangles.size(); ++t)
    bar.triangles.row(Eigen::Index(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
  return bar;
}

const std::vector<int> kArapHandles = {0, 2, 4, 6, 72, 74, 76, 78};

TEST(ArapDeformer, MovesRigidlyAtNoEnergy) {
  const geometry::TriangleMesh bar = ArapBar();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const geometry::Points moved = (bar.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  const geometry::ArapDeformation result =
      geometry::ArapDeformer(bar, kArapHandles).Solve(moved(kArapHandles, Eigen::all), 300);
  EXPECT_LT((result.vertices - moved).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_LT(result.energies.back(), 1e-5);
}

TEST(ArapDeformer, KeepsTheMeshWhereHandlesDoNotMove) {
  const geometry::TriangleMesh bar = ArapBar();
  const geometry::ArapDeformation result =
      geometry::ArapDeformer(bar, kArapHandles).Solve(bar.vertices(kArapHandles, Eigen::all));
  EXPECT_LT((result.vertices - bar.vertices).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(ArapDeformer, EnergyNeverRisesAndHandlesAreReached) {
  const geometry::TriangleMesh bar = ArapBar();
  geometry::Points targets = bar.vertices(kArapHandles, Eigen::all);
  targets.bottomRows(4).rowwise() += Eigen::RowVector3d(4, 0, -2);
  const geometry::ArapDeformer deformer(bar, kArapHandles);
  const geometry::ArapDeformation result = deformer.Solve(targets, 40);
  ASSERT_EQ(result.energies.size(), 41u);
  for (size_t i = 1; i < result.energies.size(); ++i)
    EXPECT_LE(result.energies[i], result.energies[i - 1] * (1 + 1e-12)) << i;
  EXPECT_LT((geometry::Points(result.vertices(kArapHandles, Eigen::all)) - targets).cwiseAbs().maxCoeff(), 1e-12);
  // Another solve with the same factor, from the last shape, continues where that ended.
  const geometry::ArapDeformation more = deformer.Solve(targets, 5, result.vertices);
  EXPECT_LE(more.energies.back(), result.energies.back() * (1 + 1e-12));
}

TEST(ArapDeformer, RefusesHandlesThatDoNotHoldTheMesh) {
  const geometry::TriangleMesh bar = ArapBar();
  ExpectError([&] { geometry::ArapDeformer(bar, {}); }, "no handle");
  ExpectError([&] { geometry::ArapDeformer(bar, {3, 3}); }, "twice");
  ExpectError([&] { geometry::ArapDeformer(bar, {500}); }, "no vertex");
  geometry::TriangleMesh two = bar;
  two.vertices.conservativeResize(bar.vertices.rows() * 2, 3);
  two.vertices.bottomRows(bar.vertices.rows()) = bar.vertices.rowwise() + Eigen::RowVector3d(10, 0, 0);
  two.triangles.conservativeResize(bar.triangles.rows() * 2, 3);
  two.triangles.bottomRows(bar.triangles.rows()) = bar.triangles.array() + int(bar.vertices.rows());
  ExpectError([&] { geometry::ArapDeformer(two, kArapHandles); }, "a part of the mesh has no handle");
}

}  // namespace
}  // namespace daumier::testing
