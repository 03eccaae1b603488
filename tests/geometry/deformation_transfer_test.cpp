#include "geometry/deformation_transfer.h"

#include "geometry/normals.h"
#include "geometry/obj.h"
#include "geometry/triangulate.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

/// The upper half of a sphere is twisted and stretched upwards; what lies below stays.
Points Bend(const Points& points) {
  Points bent = points;
  for (Eigen::Index v = 0; v < bent.rows(); ++v) {
    const double height = std::max(0.0, points(v, 2));
    const Eigen::AngleAxisd twist(0.8 * height, Vector3::UnitZ());
    bent.row(v) = (twist * Vector3(points.row(v)) + Vector3(0.1, 0, 0.5) * height * height).transpose();
  }
  return bent;
}

/// A lumpy sphere, unlike any similarity of a sphere.
TriangleMesh Potato(int depth) {
  TriangleMesh mesh = testing::Sphere(1, depth);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Vector3 p = mesh.vertices.row(v);
    mesh.vertices.row(v) *= 1 + 0.2 * std::sin(3 * p.x() + p.y()) + 0.1 * std::cos(4 * p.z());
  }
  return mesh;
}

const double kPlanar = 1e-12;
std::vector<int> LowerHalf(const TriangleMesh& mesh) {
  return StaticVertices(mesh.vertices, {Bend(mesh.vertices)}, kPlanar);
}

TEST(DeformationTransfer, OntoItsOwnReferenceGivesTheDeformedMesh) {
  const TriangleMesh sphere = testing::Sphere(1, 3);
  const Points bent = Bend(sphere.vertices);
  const Points result = TransferDeformation(sphere, bent, sphere, LowerHalf(sphere));
  EXPECT_LT((result - bent).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(DeformationTransfer, NoDeformationGivesTheTarget) {
  const TriangleMesh sphere = testing::Sphere(1, 2), potato = Potato(2);
  const auto none = ComputeDeformationGradients(sphere, sphere.vertices);
  EXPECT_TRUE(none.triangles.empty());
  EXPECT_LT((DeformationTransfer(potato, {0}).Apply(none) - potato.vertices).norm(), 1e-14);
}

TEST(DeformationTransfer, AppliesFromSeveralThreads) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  const auto gradients = ComputeDeformationGradients(sphere, Bend(sphere.vertices));
  const DeformationTransfer transfer(Potato(2), LowerHalf(sphere));
  testing::ExpectTheSameFromThreads(10, [&] { return transfer.Apply(gradients); });
}

TEST(DeformationTransfer, AScaledAndMovedTargetGetsTheDeformationScaled) {
  const TriangleMesh sphere = testing::Sphere(1, 2);
  TriangleMesh target = sphere;
  target.vertices = (2.5 * sphere.vertices).rowwise() + Eigen::RowVector3d(1, 2, 3);
  const Points bent = Bend(sphere.vertices);
  const Points expected = (2.5 * bent).rowwise() + Eigen::RowVector3d(1, 2, 3);
  EXPECT_LT((TransferDeformation(sphere, bent, target, LowerHalf(sphere)) - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(DeformationTransfer, ATriangleThatIsStretchedByHand) {
  // The reference's corner 2 moves from height 1 to height 3; the target is twice as wide and half as high.
  TriangleMesh reference{Points(3, 3), Triangles(1, 3)}, target = reference;
  reference.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  reference.triangles << 0, 1, 2;
  Points deformed = reference.vertices;
  deformed(2, 1) = 3;
  target.vertices << 0, 0, 0, 2, 0, 0, 0, 0.5, 0;
  target.triangles = reference.triangles;
  const Points result = TransferDeformation(reference, deformed, target, {0, 1});
  EXPECT_LT((result.row(2) - Eigen::RowVector3d(0, 1.5, 0)).norm(), 1e-14);
}

/// The paper's own system [Sumner and Popovic 2004, eq. 8] with a fourth vertex a triangle among the unknowns, solved
/// densely.
TEST(DeformationTransfer, EqualsTheSystemWithFourthVertices) {
  const TriangleMesh sphere = testing::Sphere(1, 1), target = Potato(1);
  const Points bent = Bend(sphere.vertices);
  const auto gradients = ComputeDeformationGradients(sphere, bent, 0.0);
  const int num_vertices = static_cast<int>(sphere.vertices.rows()), num_triangles = sphere.triangles.rows();
  std::vector<Eigen::Matrix3d> wanted(num_triangles, Eigen::Matrix3d::Identity());
  for (size_t i = 0; i < gradients.triangles.size(); ++i) wanted[gradients.triangles[i]] += gradients.changes[i];

  const std::vector<int> pinned = LowerHalf(sphere);
  const double kPin = 1e6;
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3 * num_triangles + pinned.size(), num_vertices + num_triangles);
  Eigen::MatrixXd rhs = Eigen::MatrixXd::Zero(matrix.rows(), 3);
  const Eigen::VectorXd areas = TriangleAreas(target);
  const Points normals = TriangleNormals(target);
  for (int f = 0; f < num_triangles; ++f) {
    const auto corner = [&](int k) { return Vector3(target.vertices.row(target.triangles(f, k))); };
    Eigen::Matrix3d frame;
    frame << corner(1) - corner(0), corner(2) - corner(0), normals.row(f).transpose();
    const Eigen::Matrix3d inverse = frame.inverse();
    for (int column = 0; column < 3; ++column) {  // Of T: (x1 - x0, x2 - x0, x4 - x0) times a column of the inverse.
      const int row = 3 * f + column;
      const double weight = std::sqrt(areas[f]);
      matrix(row, target.triangles(f, 1)) += weight * inverse(0, column);
      matrix(row, target.triangles(f, 2)) += weight * inverse(1, column);
      matrix(row, num_vertices + f) += weight * inverse(2, column);
      matrix(row, target.triangles(f, 0)) -= weight * inverse.col(column).sum();
      rhs.row(row) = weight * wanted[f].col(column).transpose();
    }
  }
  for (size_t i = 0; i < pinned.size(); ++i) {
    matrix(3 * num_triangles + Eigen::Index(i), pinned[i]) = kPin;
    rhs.row(3 * num_triangles + Eigen::Index(i)) = kPin * target.vertices.row(pinned[i]);
  }
  const Eigen::MatrixXd solved = matrix.colPivHouseholderQr().solve(rhs);
  const Points result = DeformationTransfer(target, pinned).Apply(gradients);
  EXPECT_LT((result - solved.topRows(num_vertices)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(DeformationTransfer, RefusesWhatDoesNotFit) {
  const TriangleMesh sphere = testing::Sphere(1, 1);
  ExpectError([&] { ComputeDeformationGradients(sphere, sphere.vertices.topRows(5)); },
              "the reference has 18 vertices, its deformation 5");
  ExpectError([&] { StaticVertices(sphere.vertices, {sphere.vertices.topRows(5)}, 0); }, "a pose 5");
  Points collapsed = sphere.vertices;
  collapsed.row(sphere.triangles(3, 0)) = collapsed.row(sphere.triangles(3, 1));
  ExpectError([&] { ComputeDeformationGradients(sphere, collapsed); }, "has no area");
  ExpectError([&] { DeformationTransfer(sphere, {}); }, "no fixed vertex");
  const DeformationGradients alien{{32}, {Eigen::Matrix3d::Zero()}};
  ExpectError([&] { DeformationTransfer(sphere, {0}).Apply(alien); }, "triangle 32 of a deformation is out of range");
}

TriangleMesh ReadMesh(const std::filesystem::path& path) {
  const PolygonMesh polygons = ReadObj(path);
  return {polygons.vertices, Triangulate(polygons)};
}

TEST(DeformationTransfer, ScannedPosesComeBackOnTheirOwnReference) {
  const auto data = testing::SharedData();
  if (!data || !std::filesystem::exists(*data / "head_poses")) GTEST_SKIP() << "no head_poses next to the checkout";
  std::vector<TriangleMesh> heads;
  for (const auto& entry : std::filesystem::directory_iterator(*data / "head_poses")) {
    if (entry.path().extension() == ".obj") heads.push_back(ReadMesh(entry.path()));
  }
  ASSERT_GE(heads.size(), 2u);
  for (size_t pose = 1; pose < heads.size(); ++pose) {
    // Vertex 0 alone is pinned: the result is the pose up to a translation.
    Points result = TransferDeformation(heads[0], heads[pose].vertices, heads[0], {0});
    result.rowwise() += heads[pose].vertices.row(0) - result.row(0);
    const double size = (heads[0].vertices.colwise().maxCoeff() - heads[0].vertices.colwise().minCoeff()).maxCoeff();
    EXPECT_LT((result - heads[pose].vertices).cwiseAbs().maxCoeff(), 1e-7 * size);
  }
}

TEST(DeformationTransfer, CaricaturesComeBackOnTheirOwnReference) {
  const auto data = testing::SharedData();
  if (!data || !std::filesystem::exists(*data / "caricatures")) GTEST_SKIP() << "no caricatures next to the checkout";
  const TriangleMesh first = ReadMesh(*data / "caricatures/1.obj"), second = ReadMesh(*data / "caricatures/2.obj");
  Points result = TransferDeformation(first, second.vertices, first, {0});
  result.rowwise() += second.vertices.row(0) - result.row(0);
  const double size = (first.vertices.colwise().maxCoeff() - first.vertices.colwise().minCoeff()).maxCoeff();
  EXPECT_LT((result - second.vertices).cwiseAbs().maxCoeff(), 1e-7 * size);
}

}  // namespace
}  // namespace daumier::geometry
