#include "geometry/region_deformation.h"

#include "core/random.h"
#include "geometry/normals.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

std::vector<int> AllVertices(const TriangleMesh& mesh) {
  std::vector<int> all(size_t(mesh.vertices.rows()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The vertices of a sphere above a height.
std::vector<int> CapAbove(const TriangleMesh& mesh, double z) {
  std::vector<int> cap;
  for (int v = 0; v < mesh.vertices.rows(); ++v)
    if (mesh.vertices(v, 2) > z) cap.push_back(v);
  return cap;
}

Eigen::MatrixXd RandomHandleMoves(Eigen::Index count) {
  Rng rng(4);
  Eigen::MatrixXd moves(count, 3);
  for (double& x : moves.reshaped()) x = rng.Normal();
  return moves;
}

/// E over all vertices with the handles and the outside as they are, dense.
Eigen::MatrixXd DenseSolution(const TriangleMesh& mesh, const std::vector<int>& region, double reach,
                              const std::vector<int>& handles, const Eigen::MatrixXd& moves) {
  const Eigen::MatrixXd laplacian = CotangentLaplacian(mesh);
  const Eigen::VectorXd areas = VertexAreas(mesh);
  Eigen::MatrixXd rows = areas.cwiseInverse().asDiagonal() * laplacian;
  rows.diagonal().array() += 1 / (reach * reach);
  rows = areas.cwiseSqrt().asDiagonal() * rows;
  std::vector<int> free;
  for (const int v : region)
    if (std::ranges::count(handles, v) == 0) free.push_back(v);
  const Eigen::MatrixXd of_free = rows(Eigen::all, free), of_handles = rows(Eigen::all, handles);
  const Eigen::MatrixXd solved =
      (of_free.transpose() * of_free).ldlt().solve(-of_free.transpose() * (of_handles * moves));
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(mesh.vertices.rows(), moves.cols());
  all(free, Eigen::all) = solved;
  all(handles, Eigen::all) = moves;
  return all(region, Eigen::all);
}

TEST(RegionDeformation, SolvesTheEnergyOfTheWholeSurface) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const SurfaceStiffness stiffness = MakeSurfaceStiffness(sphere);
  for (const double reach : {0.5, 100.0}) {
    const std::vector<int> region = CapAbove(sphere, -0.3);
    // One handle alone, and a patch with handles inside of it that touch no free vertex.
    for (const std::vector<int>& handles : {std::vector<int>{4}, CapAbove(sphere, 0.9)}) {
      const Eigen::MatrixXd moves = RandomHandleMoves(std::ssize(handles));
      const Eigen::MatrixXd found = RegionDeformation(stiffness, region, reach).Solve(handles, moves);
      EXPECT_LT((found - DenseSolution(sphere, region, reach, handles, moves)).cwiseAbs().maxCoeff(), 1e-8);
    }
  }
}

TEST(RegionDeformation, SolvesTheEnergyForManyHandles) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  const std::vector<int> region = CapAbove(sphere, -1.5);
  std::vector<int> handles;  // Two of three, so that each is next to a free vertex.
  for (const int v : region)
    if (v % 3 != 0) handles.push_back(v);
  ASSERT_GT(handles.size(), 400u);
  const Eigen::MatrixXd moves = RandomHandleMoves(std::ssize(handles));
  const Eigen::MatrixXd found = RegionDeformation(MakeSurfaceStiffness(sphere), region, 3).Solve(handles, moves);
  EXPECT_LT((found - DenseSolution(sphere, region, 3, handles, moves)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(RegionDeformation, HandlesMoveExactlyAndNoMoveChangesNothing) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const std::vector<int> region = CapAbove(sphere, 0), handles = CapAbove(sphere, 1.5);
  const RegionDeformation deformation(MakeSurfaceStiffness(sphere), region, 3);
  const Eigen::MatrixXd moves = RandomHandleMoves(std::ssize(handles));
  const Eigen::MatrixXd found = deformation.Solve(handles, moves);
  for (size_t k = 0; k < handles.size(); ++k) {
    const auto place = std::ranges::find(deformation.region(), handles[k]) - deformation.region().begin();
    EXPECT_EQ(found.row(place), moves.row(Eigen::Index(k)));
  }
  EXPECT_TRUE(deformation.Solve(handles, 0 * moves).isZero(0));
  EXPECT_EQ(deformation.Solve(region, RandomHandleMoves(std::ssize(region))), RandomHandleMoves(std::ssize(region)))
      << "all are handles";
}

TEST(RegionDeformation, IsLinearInItsMoves) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const std::vector<int> handles = {4, 20, 33};
  const RegionDeformation deformation(MakeSurfaceStiffness(sphere), AllVertices(sphere), 1);
  const Eigen::MatrixXd a = RandomHandleMoves(3), b = a.colwise().reverse();
  const Eigen::MatrixXd together = deformation.Solve(handles, 2 * a - 3 * b);
  EXPECT_LT((together - (2 * deformation.Solve(handles, a) - 3 * deformation.Solve(handles, b))).cwiseAbs().maxCoeff(),
            1e-9);
}

TEST(RegionDeformation, AFrontFadesWithTheDistance) {
  const int n = 60;
  TriangleMesh strip = testing::FlatSheet(n);
  strip.vertices *= 12;  // cm
  std::vector<int> handles;
  double front = 0;
  for (int v = 0; v < strip.vertices.rows(); ++v) {
    if (strip.vertices(v, 0) > 1.9) continue;
    handles.push_back(v);
    front = std::max(front, strip.vertices(v, 0));
  }
  const double reach = 1.5;
  const RegionDeformation deformation(MakeSurfaceStiffness(strip), AllVertices(strip), reach);
  const Eigen::VectorXd found = deformation.Solve(handles, Eigen::MatrixXd::Ones(std::ssize(handles), 1));
  for (int v = 0; v < strip.vertices.rows(); ++v) {
    if (strip.vertices(v, 0) > 9) continue;  // The free border of the sheet has an effect of its own.
    const double r = std::max(0.0, strip.vertices(v, 0) - front) / reach;
    EXPECT_NEAR(found[v], (1 + r) * std::exp(-r), 0.03);
  }
}

TEST(RegionDeformation, LeavesTheBorderOfTheRegionSmoothly) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  const std::vector<int> region = CapAbove(sphere, 0);
  const RegionDeformation deformation(MakeSurfaceStiffness(sphere), region, 100);
  const std::vector<int> handles = CapAbove(sphere, 1.8);
  const Eigen::VectorXd moved = deformation.Solve(handles, Eigen::MatrixXd::Ones(std::ssize(handles), 1));
  for (const Eigen::VectorXd& found : {moved, deformation.Dome(handles)}) {
    double near = 0, far = 1;  // Greatest up to 0.1 above the border, least from 0.3 on, in radians.
    for (size_t place = 0; place < region.size(); ++place) {
      const double height = std::asin(sphere.vertices(region[place], 2) / 2);
      if (height < 0.1) near = std::max(near, std::abs(found[Eigen::Index(place)]));
      if (height > 0.3) far = std::min(far, found[Eigen::Index(place)]);
    }
    EXPECT_LT(near, far / 5) << "a displacement that begins with a slope has a third";
  }
}

TEST(RegionDeformation, ADomeIsHighestOverItsHandles) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const std::vector<int> handles = CapAbove(sphere, 1.5);
  const RegionDeformation deformation(MakeSurfaceStiffness(sphere), AllVertices(sphere), 1);
  const Eigen::VectorXd dome = deformation.Dome(handles);
  EXPECT_DOUBLE_EQ(dome.maxCoeff(), 1);
  EXPECT_DOUBLE_EQ(dome[4], 1) << "vertex 4 is the pole";
  EXPECT_GT(dome.minCoeff(), -1e-3);
  for (int v = 0; v < sphere.vertices.rows(); ++v) {
    const Eigen::RowVector3d p = sphere.vertices.row(v);
    for (int other = 0; other < sphere.vertices.rows(); ++other)  // Left and right alike.
      if (sphere.vertices.row(other) == Eigen::RowVector3d(-p.x(), p.y(), p.z())) {
        EXPECT_NEAR(dome[v], dome[other], 1e-9);
      }
  }
}

TEST(RegionDeformation, MayBeUsedFromSeveralThreads) {
  const TriangleMesh sphere = testing::Sphere(2, 3);
  const RegionDeformation deformation(MakeSurfaceStiffness(sphere), CapAbove(sphere, 0), 3);
  const std::vector<int> handles = CapAbove(sphere, 1.5);
  testing::ExpectTheSameFromThreads(3, [&] {
    return Eigen::MatrixXd(deformation.Solve(handles, RandomHandleMoves(std::ssize(handles))) *
                           deformation.Dome(handles).maxCoeff());
  });
}

TEST(RegionDeformation, RefusesWhatItCannotSolve) {
  const TriangleMesh sphere = testing::Sphere(2, 2);
  const SurfaceStiffness stiffness = MakeSurfaceStiffness(sphere);
  ExpectError([&] { RegionDeformation(stiffness, {}, 1); }, "a region without vertices");
  ExpectError([&] { RegionDeformation(stiffness, {0, 1000}, 1); }, "vertex 1000 of a region is out of range");
  ExpectError([&] { RegionDeformation(stiffness, {3, 3}, 1); }, "vertex 3 is in a region twice");
  ExpectError([&] { RegionDeformation(stiffness, {3}, 0); }, "a reach of 0 cm");
  ExpectError([&] { RegionDeformation(stiffness, {3}, NAN); }, "expected a positive one");
  const RegionDeformation deformation(stiffness, {0, 1, 2, 3, 4}, 1);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 3);
  ExpectError([&] { deformation.Solve({}, Eigen::MatrixXd(0, 3)); }, "there is no handle");
  ExpectError([&] { deformation.Solve({9}, one); }, "handle 9 is not in the region");
  ExpectError([&] { deformation.Solve({-1}, one); }, "handle -1 is not in the region");
  ExpectError([&] { deformation.Solve({2, 2}, Eigen::MatrixXd::Ones(2, 3)); }, "vertex 2 is a handle twice");
  ExpectError([&] { deformation.Solve({2}, Eigen::MatrixXd::Ones(2, 3)); }, "2 moves for 1 handles");
  ExpectError([&] { deformation.Solve({2}, NAN * one); }, "not finite");
  ExpectError([&] { deformation.Dome({}); }, "there is no handle");
  TriangleMesh loose = sphere;
  loose.vertices.conservativeResize(loose.vertices.rows() + 1, 3);
  loose.vertices.bottomRows(1).setZero();
  ExpectError([&] { MakeSurfaceStiffness(loose); }, "belongs to no triangle");
}

}  // namespace
}  // namespace daumier::geometry
