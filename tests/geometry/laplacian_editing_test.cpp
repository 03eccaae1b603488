#include "geometry/laplacian_editing.h"

#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <limits>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

const TriangleMesh& Bumps() {
  static const TriangleMesh mesh =
      testing::Sheet(8, [](double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y) + 0.2 * x * y; });
  return mesh;
}
const std::vector<int> kHandles = {0, 8, 72, 80, 40, 22};

Eigen::VectorXd Weights(double weight) {
  return Eigen::VectorXd::Constant(kHandles.size(), weight);
}

TEST(LaplacianEditing, HandlesAtRestGiveTheMesh) {
  const Points targets = Bumps().vertices(kHandles, Eigen::all);
  EXPECT_LT((EditLaplacian(Bumps(), kHandles, Weights(1), targets) - Bumps().vertices).norm(), 1e-10);
}

TEST(LaplacianEditing, ScalesShiftsAndFirstOrderRotationsOfTheHandlesMoveTheWholeMesh) {
  const Vector3 turn(0.3, -0.2, 0.5), shift(1, -2, 3);
  Points expected = 1.7 * Bumps().vertices;
  for (int v = 0; v < expected.rows(); ++v)
    expected.row(v) += turn.cross(Vector3(Bumps().vertices.row(v))).transpose() + shift.transpose();
  const Points edited = EditLaplacian(Bumps(), kHandles, Weights(1), expected(kHandles, Eigen::all));
  EXPECT_LT((edited - expected).norm(), 1e-9);
}

TEST(LaplacianEditing, ARotationHoldsToSecondOrderInItsAngle) {
  const auto error = [](double angle) {
    const Eigen::AngleAxisd rotation(angle, Vector3(1, 2, 3).normalized());
    const Points expected = Bumps().vertices * rotation.toRotationMatrix().transpose();
    return (EditLaplacian(Bumps(), kHandles, Weights(1), expected(kHandles, Eigen::all)) - expected).norm();
  };
  EXPECT_GT(error(0.1), 0);
  EXPECT_LT(error(0.1), 0.02);
  EXPECT_NEAR(error(0.1) / error(0.05), 4, 0.2);
}

TEST(LaplacianEditing, HeavyHandlesAreMetAndLightOnesGiveWay) {
  Points targets = Bumps().vertices(kHandles, Eigen::all);
  targets(4, 2) += 0.5;
  const auto miss = [&](double weight) {
    return (EditLaplacian(Bumps(), kHandles, Weights(weight), targets)(kHandles, Eigen::all) - targets).norm();
  };
  EXPECT_LT(miss(1e4), 1e-4);
  EXPECT_GT(miss(1e-3), 10 * miss(1e4));
}

TEST(LaplacianEditing, IsTheLeastSquaresSolutionOfItsEnergy) {
  // The T_i are recomputed as the least-squares fit of s p + h x p + t, by a dense solve a vertex.
  const TriangleMesh& mesh = Bumps();
  const int num_vertices = static_cast<int>(mesh.vertices.rows()), num_handles = static_cast<int>(kHandles.size());
  const Adjacency neighbours = VertexNeighbours(mesh.triangles, num_vertices);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(3 * (num_vertices + num_handles), 3 * num_vertices);
  for (int i = 0; i < num_vertices; ++i) {
    std::vector<int> ring(neighbours[i].begin(), neighbours[i].end());
    Vector3 detail = mesh.vertices.row(i) - mesh.vertices(ring, Eigen::all).colwise().mean();
    for (int axis = 0; axis < 3; ++axis) {
      system(3 * i + axis, 3 * i + axis) += 1;
      for (const int j : ring) system(3 * i + axis, 3 * j + axis) -= 1.0 / double(ring.size());
    }
    // A corner has too few neighbours: two rings.
    ring = VerticesWithin(neighbours, {i}, ring.size() < 4 ? 2 : 1);
    const auto linear = [](const Vector3& p) {
      Eigen::Matrix<double, 3, 4> matrix;
      matrix << p.x(), 0, p.z(), -p.y(), p.y(), -p.z(), 0, p.x(), p.z(), p.y(), -p.x(), 0;
      return matrix;
    };
    Eigen::MatrixXd fit(3 * ring.size(), 7);
    for (size_t j = 0; j < ring.size(); ++j)
      fit.middleRows<3>(3 * j) << linear(mesh.vertices.row(ring[j])), Eigen::Matrix3d::Identity();
    const Eigen::MatrixXd solve =
        linear(detail) * fit.completeOrthogonalDecomposition().pseudoInverse().topRows(4).eval();
    for (size_t j = 0; j < ring.size(); ++j) system.block<3, 3>(3 * i, 3 * ring[j]) -= solve.middleCols<3>(3 * j);
  }
  const double weight = 2;
  Points targets = mesh.vertices(kHandles, Eigen::all);
  targets.row(1) += Eigen::RowVector3d(0.2, 0.1, 0.4);
  targets.row(5) += Eigen::RowVector3d(0, -0.1, 0.2);
  Eigen::VectorXd rhs = Eigen::VectorXd::Zero(system.rows());
  for (int k = 0; k < num_handles; ++k) {
    const int row = 3 * (num_vertices + k);
    system.block<3, 3>(row, 3 * kHandles[k]) = std::sqrt(weight) * Eigen::Matrix3d::Identity();
    rhs.segment<3>(row) = std::sqrt(weight) * targets.row(k).transpose();
  }
  const Eigen::VectorXd solution = system.colPivHouseholderQr().solve(rhs);
  const Points expected = Eigen::Map<const Points>(solution.data(), num_vertices, 3);
  EXPECT_LT((EditLaplacian(mesh, kHandles, Weights(weight), targets) - expected).norm(), 1e-8);
}

TEST(LaplacianEditing, TheTipOfABorderIsNotLoose) {
  // A triangle hangs at the sheet's upper border by one edge; its tip has two neighbours.
  TriangleMesh mesh = Bumps();
  mesh.vertices.conservativeResize(82, 3);
  mesh.vertices.row(81) << 0.56, 1.1, 0.1;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << 77, 76, 81;
  Points targets = mesh.vertices(kHandles, Eigen::all);
  targets(4, 2) += 0.3;
  const Points edited = EditLaplacian(mesh, kHandles, Weights(1), targets);
  EXPECT_LT((edited - mesh.vertices).row(81).norm(), 0.4);
}

TEST(LaplacianEditing, BothDoorsAgree) {
  const LaplacianEditor editor(Bumps(), kHandles, Weights(3));
  Points targets = Bumps().vertices(kHandles, Eigen::all);
  for (int round = 0; round < 2; ++round) {
    targets.row(round) *= 1.5;
    EXPECT_EQ(editor.Solve(targets), EditLaplacian(Bumps(), kHandles, Weights(3), targets));
  }
}

TEST(LaplacianEditing, RefusesWhatDoesNotHoldTheMesh) {
  const Points targets = Bumps().vertices(kHandles, Eigen::all);
  ExpectError([] { LaplacianEditor(Bumps(), {}, {}); }, "do not hold the mesh");
  ExpectError([] { LaplacianEditor(Bumps(), {0, 80}, Eigen::VectorXd::Ones(2)); }, "do not hold the mesh");
  ExpectError([] { LaplacianEditor(Bumps(), {0, 8, 81}, Eigen::VectorXd::Ones(3)); }, "handle 81 is out of range");
  ExpectError([] { LaplacianEditor(Bumps(), {0, 8, 8}, Eigen::VectorXd::Ones(3)); }, "vertex 8 is a handle twice");
  ExpectError([] { LaplacianEditor(Bumps(), {0, 8, 72}, Eigen::VectorXd::Zero(3)); }, "not positive");
  ExpectError([] { LaplacianEditor(Bumps(), {0, 8, 72}, Eigen::VectorXd::Ones(2)); }, "2 weights for 3 handles");
  TriangleMesh loose = Bumps();
  loose.vertices.conservativeResize(82, 3);
  loose.vertices.row(81).setZero();
  ExpectError([&] { LaplacianEditor(loose, kHandles, Weights(1)); }, "vertex 81 belongs to no triangle");
  const LaplacianEditor editor(Bumps(), kHandles, Weights(1));
  ExpectError([&] { editor.Solve(targets.topRows(2)); }, "2 targets for 6 handles");
  Points broken = targets;
  broken(0, 0) = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { editor.Solve(broken); }, "not finite");
}

}  // namespace
}  // namespace daumier::geometry
