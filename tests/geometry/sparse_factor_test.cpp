#include "geometry/sparse_factor.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <thread>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

/// I + L of a sphere.
SparseMatrix Shifted() {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  const int count = int(sphere.vertices.rows());
  SparseMatrix one(count, count);
  one.setIdentity();
  return one + UniformLaplacian(sphere.triangles, count);
}

Points RandomSides(Eigen::Index count) {
  Rng rng(3);
  Points sides(count, 3);
  for (double& x : sides.reshaped()) x = rng.Normal();
  return sides;
}

TEST(SparseFactor, SolvesAsADenseFactor) {
  const SparseMatrix matrix = Shifted();
  const Points sides = RandomSides(matrix.rows());
  const Eigen::MatrixXd expected = Eigen::MatrixXd(matrix).llt().solve(Eigen::MatrixXd(sides));
  EXPECT_LT((SparseFactor(matrix).Solve(sides) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SparseFactor, TwoEquationsByHand) {
  SparseMatrix matrix(2, 2);
  matrix.insert(0, 0) = 4;
  matrix.insert(1, 0) = matrix.insert(0, 1) = 2;
  matrix.insert(1, 1) = 5;
  const Points sides = (Points(2, 3) << 8, 6, 4, 12, 7, 2).finished();
  const Points expected = (Points(2, 3) << 1, 1, 1, 2, 1, 0).finished();
  EXPECT_LT((SparseFactor(matrix).Solve(sides) - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SparseFactor, MayBeUsedFromSeveralThreads) {
  const SparseMatrix matrix = Shifted();
  const SparseFactor factor(matrix);
  const Points sides = RandomSides(matrix.rows()), expected = factor.Solve(sides);
  std::vector<Points> found(4);
  std::vector<std::jthread> threads;
  for (Points& one : found) threads.emplace_back([&] { one = factor.Solve(sides); });
  threads.clear();
  for (const Points& one : found) EXPECT_EQ(one, expected);
}

TEST(SparseFactor, RefusesWhatItCannotSolve) {
  const SparseMatrix matrix = Shifted();
  ExpectError([&] { SparseFactor(matrix.leftCols(3)); }, "expected a square one");
  ExpectError([&] { SparseFactor(matrix).Solve(Points::Zero(3, 3)); }, "3 rows on the right-hand side");
  const SparseFactor negative(SparseMatrix(-matrix));
  EXPECT_FALSE(negative.is_positive());
  ExpectError([&] { negative.Solve(RandomSides(matrix.rows())); }, "not positive definite");
}

}  // namespace
}  // namespace daumier::geometry
