#include "geometry/laplacian_anchors.h"

#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <cmath>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

struct AnchorProblem {
  SparseMatrix laplacian;
  std::vector<int> ids = {3, 40, 61, 12, 30};
  Points moves{5, 3};
  Eigen::VectorXd weights{{1.0, 0.2, 30.0, 1e4, 0.0}};
};

AnchorProblem MakeAnchorProblem(const SparseMatrix& laplacian) {
  AnchorProblem problem{laplacian};
  Rng rng(3);
  for (double& x : problem.moves.reshaped()) x = rng.Normal();
  return problem;
}

/// The normal equations as they are written down, dense.
Points DirectSolution(const AnchorProblem& problem) {
  const Eigen::MatrixXd s = problem.laplacian;
  const Eigen::MatrixXd l = s.diagonal().cwiseInverse().asDiagonal() * s;
  Eigen::MatrixXd system = l.transpose() * l, rhs = Eigen::MatrixXd::Zero(s.rows(), 3);
  for (size_t k = 0; k < problem.ids.size(); ++k) {
    const double weight = problem.weights[Eigen::Index(k)];
    system(problem.ids[k], problem.ids[k]) += weight;
    rhs.row(problem.ids[k]) += weight * problem.moves.row(Eigen::Index(k));
  }
  return system.ldlt().solve(rhs);
}

TEST(LaplacianAnchors, SolvesTheNormalEquations) {
  const TriangleMesh sphere = testing::Sphere(1, 2), torus = testing::Torus(3, 1, 16, 10);
  for (const SparseMatrix& laplacian :
       {UniformLaplacian(sphere.triangles, int(sphere.vertices.rows())), CotangentLaplacian(torus)}) {
    const AnchorProblem problem = MakeAnchorProblem(laplacian);
    const Points expected = DirectSolution(problem);
    for (const AnchorUse use : {AnchorUse::kOnce, AnchorUse::kOften}) {
      const LaplacianAnchors anchors(laplacian, problem.ids, use);
      EXPECT_LT((anchors.Solve(problem.moves, problem.weights) - expected).cwiseAbs().maxCoeff(), 1e-8);
      EXPECT_LT((anchors.SolveAnchors(problem.moves, problem.weights) - expected(problem.ids, Eigen::all))
                    .cwiseAbs()
                    .maxCoeff(),
                1e-8);
    }
  }
}

TEST(LaplacianAnchors, EqualMovesShiftTheSurface) {
  const TriangleMesh sheet = testing::FlatSheet(12);
  const LaplacianAnchors anchors(UniformLaplacian(sheet.triangles, int(sheet.vertices.rows())), {0, 20, 100});
  const Eigen::RowVector3d shift(0.3, -2, 7);
  const Points moved = anchors.Solve(shift.replicate(3, 1), Eigen::Vector3d(0.1, 1, 50));
  EXPECT_LT((moved.rowwise() - shift).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LaplacianAnchors, OneAnchorCarriesEverythingAlong) {
  const TriangleMesh sphere = testing::Sphere(1, 1);
  const LaplacianAnchors anchors(CotangentLaplacian(sphere), {5});
  const Points moved = anchors.Solve(Eigen::RowVector3d(1, 2, 3), Eigen::VectorXd::Constant(1, 0.01));
  EXPECT_LT((moved.rowwise() - Eigen::RowVector3d(1, 2, 3)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LaplacianAnchors, LargerWeightsComeNearer) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  AnchorProblem problem = MakeAnchorProblem(UniformLaplacian(sphere.triangles, int(sphere.vertices.rows())));
  const LaplacianAnchors anchors(problem.laplacian, problem.ids);
  double last = std::numeric_limits<double>::infinity();
  for (const double weight : {0.01, 0.1, 1.0, 10.0, 1e6}) {
    problem.weights.setConstant(weight);
    const double left = (anchors.SolveAnchors(problem.moves, problem.weights) - problem.moves).norm();
    EXPECT_LT(left, last);
    last = left;
  }
  EXPECT_LT(last, 1e-4);
}

TEST(LaplacianAnchors, AnAnchorOfWeightZeroMayBeAnything) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  AnchorProblem problem = MakeAnchorProblem(UniformLaplacian(sphere.triangles, int(sphere.vertices.rows())));
  const LaplacianAnchors anchors(problem.laplacian, problem.ids);
  const Points before = anchors.Solve(problem.moves, problem.weights);
  problem.moves.row(4).setConstant(std::nan(""));
  EXPECT_EQ(before, anchors.Solve(problem.moves, problem.weights));
}

TEST(LaplacianAnchors, RefusesWhatHoldsNothing) {
  const TriangleMesh sphere = testing::Sphere(1, 1);
  const SparseMatrix laplacian = CotangentLaplacian(sphere);
  ExpectError([&] { LaplacianAnchors(laplacian, {1, 1}); }, "vertex 1 is an anchor twice");
  ExpectError([&] { LaplacianAnchors(laplacian, {100000}); }, "anchor 100000 is out of range");
  ExpectError([&] { LaplacianAnchors(laplacian.leftCols(3), {1}); }, "not square");
  const LaplacianAnchors anchors(laplacian, {1, 2});
  const Points moves = Points::Ones(2, 3);
  ExpectError([&] { anchors.Solve(moves, Eigen::Vector2d(1, -1)); }, "anchor 1 has the weight -1");
  ExpectError([&] { anchors.Solve(moves, Eigen::Vector2d::Zero()); }, "none of 2 anchors has a weight");
  ExpectError([&] { anchors.Solve(moves.topRows(1), Eigen::Vector2d::Ones()); }, "1 moves and 2 weights of 2 anchors");
  ExpectError([&] { anchors.Solve(moves * std::nan(""), Eigen::Vector2d::Ones()); }, "not finite");
  const Triangles two_parts{{0, 1, 2}, {3, 4, 5}};
  ExpectError([&] { LaplacianAnchors(UniformLaplacian(two_parts, 6), {0}); }, "not connected");
}

}  // namespace
}  // namespace daumier::geometry
