#include "geometry/poisson.h"

#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

TEST(Poisson, LinearFunctionIsHarmonic) {
  const TriangleMesh sheet = testing::FlatSheet(6);
  const std::vector<int> rim = BoundaryLoops(sheet.triangles, 49)[0];
  const Eigen::VectorXd values = sheet.vertices * Vector3(1, 2, 0);
  const Eigen::MatrixXd solution =
      SolvePoisson(CotangentLaplacian(sheet, kUnclamped), rim, Eigen::MatrixXd::Zero(49, 1), values(rim));
  EXPECT_LT((solution - values).norm(), 1e-12);
}

TEST(Poisson, RebuildsASurfaceFromItsGradients) {
  const TriangleMesh torus = testing::Torus(3, 1, 16, 10);
  const std::vector<int> fixed = {17, 3};
  const PoissonSolver solver(CotangentLaplacian(torus, kUnclamped), fixed);
  const Eigen::MatrixXd rhs = Divergence(torus) * (Gradient(torus) * torus.vertices);
  EXPECT_LT((solver.Solve(rhs, torus.vertices(fixed, Eigen::all)) - torus.vertices).norm(), 1e-10);
}

TEST(Poisson, BothDoorsAgreeAndFixedValuesAreUntouched) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  const SparseMatrix laplacian = CotangentLaplacian(sphere);
  const std::vector<int> fixed = {5, 0, 9};
  const Eigen::MatrixXd rhs = sphere.vertices, values = Eigen::MatrixXd::Constant(3, 3, 0.1);
  const Eigen::MatrixXd one = SolvePoisson(laplacian, fixed, rhs, values);
  EXPECT_EQ(one, PoissonSolver(laplacian, fixed).Solve(rhs, values));
  EXPECT_EQ(one(fixed, Eigen::all), values);
}

TEST(Poisson, AllFixedGivesTheFixedValues) {
  const SparseMatrix laplacian = CotangentLaplacian(testing::EquilateralTriangle());
  const Eigen::Vector3d values(1, 2, 3);
  EXPECT_EQ(SolvePoisson(laplacian, {0, 1, 2}, Eigen::Vector3d::Zero(), values), values);
}

TEST(Poisson, RefusesSingularAndMisshapenSystems) {
  const TriangleMesh sheet = testing::FlatSheet(3);
  const SparseMatrix laplacian = CotangentLaplacian(sheet);
  ExpectError([&] { PoissonSolver(laplacian, {}); }, "singular");
  TriangleMesh two{Points(6, 3), Triangles(2, 3)};
  two.vertices << testing::EquilateralTriangle().vertices, testing::EquilateralTriangle().vertices;
  two.triangles << 0, 1, 2, 3, 4, 5;
  ExpectError([&] { PoissonSolver(CotangentLaplacian(two), {0}); }, "singular");
  ExpectError([&] { PoissonSolver(laplacian, {16}); }, "fixed vertex 16 is out of range");
  ExpectError([&] { PoissonSolver(laplacian, {1, 1}); }, "vertex 1 is fixed twice");
  ExpectError([&] { PoissonSolver(Gradient(sheet), {0}); }, "not square");
  const PoissonSolver solver(laplacian, {0});
  ExpectError([&] { solver.Solve(Eigen::MatrixXd::Zero(3, 1), Eigen::MatrixXd::Zero(1, 1)); }, "3 rows, expected 16");
  ExpectError([&] { solver.Solve(Eigen::MatrixXd::Zero(16, 1), Eigen::MatrixXd::Zero(2, 1)); },
              "fixed values are 2 x 1");
}

}  // namespace
}  // namespace daumier::geometry
