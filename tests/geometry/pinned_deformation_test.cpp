#include "geometry/pinned_deformation.h"

#include "core/random.h"
#include "geometry/laplacian_anchors.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

SparseMatrix SphereLaplacian() {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  return UniformLaplacian(sphere.triangles, int(sphere.vertices.rows()));
}

Points RandomMoves(int count) {
  Rng rng(3);
  Points moves(count, 3);
  for (double& x : moves.reshaped()) x = rng.Normal();
  return moves;
}

TEST(PinnedDeformation, IsTheLimitOfHeavyAnchors) {
  const SparseMatrix laplacian = SphereLaplacian();
  const std::vector<int> pins = {3, 40, 61, 12};
  const Points moves = RandomMoves(4), found = PinnedDeformation(laplacian, pins).Solve(moves);
  const Points expected = LaplacianAnchors(laplacian, pins).Solve(moves, Eigen::VectorXd::Constant(4, 1e9));
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_EQ(found(pins, Eigen::all), moves) << "exactly";
}

TEST(PinnedDeformation, EqualMovesMoveTheWholeSurface) {
  const PinnedDeformation deformation(SphereLaplacian(), {5, 17});
  const Eigen::RowVector3d shift(0.3, -2, 7);
  const Points moved = deformation.Solve(shift.replicate(2, 1));
  EXPECT_LT((moved.rowwise() - shift).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(deformation.Solve(Points::Zero(2, 3)), Points::Zero(moved.rows(), 3));
}

TEST(PinnedDeformation, IsLinearInItsMoves) {
  const PinnedDeformation deformation(SphereLaplacian(), {5, 17, 30});
  const Points a = RandomMoves(3), b = a.colwise().reverse();
  const Points sum = deformation.Solve(2 * a - 3 * b), parts = 2 * deformation.Solve(a) - 3 * deformation.Solve(b);
  EXPECT_LT((sum - parts).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PinnedDeformation, MayBeUsedFromSeveralThreads) {
  const PinnedDeformation deformation(SphereLaplacian(), {5, 17, 30});
  const Points moves = RandomMoves(3), expected = deformation.Solve(moves);
  std::vector<Points> found(4);
  std::vector<std::jthread> threads;
  for (Points& one : found) threads.emplace_back([&] { one = deformation.Solve(moves); });
  threads.clear();
  for (const Points& one : found) EXPECT_EQ(one, expected);
}

TEST(PinnedDeformation, RefusesWhatItCannotSolve) {
  const SparseMatrix laplacian = SphereLaplacian();
  ExpectError([&] { PinnedDeformation(laplacian, {-1}); }, "pin -1 is out of range");
  ExpectError([&] { PinnedDeformation(laplacian, {2, 2}); }, "vertex 2 is pinned twice");
  ExpectError([&] { PinnedDeformation(laplacian, {}); }, "0 pins do not hold the surface");
  ExpectError([&] { PinnedDeformation(laplacian.leftCols(3), {0}); }, "expected a square one");
  const PinnedDeformation deformation(laplacian, {1, 2});
  ExpectError([&] { deformation.Solve(Points::Zero(3, 3)); }, "3 moves for 2 pins");
  ExpectError([&] { deformation.Solve(Points::Constant(2, 3, NAN)); }, "not finite");
  const Triangles apart = (Triangles(2, 3) << 0, 1, 2, 3, 4, 5).finished();
  ExpectError([&] { PinnedDeformation(UniformLaplacian(apart, 6), {0}); }, "each part of it needs one");
}

}  // namespace
}  // namespace daumier::geometry
