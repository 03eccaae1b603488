#include "faces/gradient_scaling.h"

#include "geometry/flips.h"
#include "geometry/operators.h"
#include "geometry/topology.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Points;

struct Head {
  FaceTemplate face = testing::SyntheticFace();
  geometry::TriangleMesh mesh{face.neutral, face.triangles};
};

TEST(GradientScaling, NoScaleReturnsTheSurface) {
  const Head head;
  const Points result = GradientScaling(head.mesh, {3}).Rebuild(Points::Zero(head.face.num_vertices(), 3));
  EXPECT_LT((result - head.face.neutral).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(GradientScaling, OneConstantScalesAboutTheFixedVertex) {
  const Head head;
  const Points logs = Points::Constant(head.face.num_vertices(), 3, std::log(1.5));
  const Points result = GradientScaling(head.mesh, {3}).Rebuild(logs);
  const Points expected =
      (1.5 * (head.face.neutral.rowwise() - head.face.neutral.row(3))).rowwise() + head.face.neutral.row(3);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(GradientScaling, EachCoordinateHasItsOwnScale) {
  const Head head;
  Points logs = Points::Zero(head.face.num_vertices(), 3);
  logs.col(1).setConstant(std::log(2.0));
  const Points result = GradientScaling(head.mesh, {3}).Rebuild(logs);
  EXPECT_LT((result.col(0) - head.face.neutral.col(0)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_NEAR(result(40, 1) - result(3, 1), 2 * (head.face.neutral(40, 1) - head.face.neutral(3, 1)), 1e-9);
}

/// The same system by the sparse operators of geometry/.
TEST(GradientScaling, EqualsTheSparseOperators) {
  const Head head;
  const int num_vertices = head.face.num_vertices();
  const std::vector<int>& fixed = head.face.annotation.regions.at("neck_border");
  Points logs(num_vertices, 3);
  for (int v = 0; v < num_vertices; ++v) logs.row(v).setConstant(0.3 * std::sin(head.face.neutral(v, 0)));
  Eigen::VectorXd scales(head.mesh.triangles.rows());
  for (int f = 0; f < scales.size(); ++f) {
    scales[f] = 0;
    for (int k = 0; k < 3; ++k) scales[f] += std::exp(logs(head.mesh.triangles(f, k), 0)) / 3;
  }
  const Eigen::MatrixXd divergence =
      geometry::CotangentLaplacian(head.mesh, geometry::kMinCotangent, scales) * head.face.neutral;
  const Points fixed_points = head.face.neutral(fixed, Eigen::all);
  const Points expected =
      geometry::SolvePoisson(geometry::CotangentLaplacian(head.mesh), fixed, divergence, fixed_points);
  EXPECT_LT((GradientScaling(head.mesh, fixed).Rebuild(logs) - expected).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(GradientScaling, ScalesThatWouldFlipTrianglesAreHalvedThere) {
  const Head head;
  Points logs(head.face.num_vertices(), 3);
  Rng rng(5);
  for (int v = 0; v < logs.rows(); ++v) logs.row(v).setConstant(1.5 * rng.Normal());
  const GradientScaling scaling(head.mesh, head.face.annotation.regions.at("neck_border"));
  const auto flips = [&](const Points& points) {
    return geometry::CountFlippedTriangles(head.face.neutral, points, head.mesh.triangles);
  };
  ASSERT_GT(flips(scaling.Rebuild(logs)), 0);
  EXPECT_EQ(flips(scaling.RebuildWithoutFlips(logs, 4)), 0);
}

TEST(GradientScaling, FadesFromTheInsideToOne) {
  const Head head;
  const auto neighbours = geometry::VertexNeighbours(head.face.triangles, head.face.num_vertices());
  const Eigen::VectorXd fade = Fade(neighbours, {7}, 0.2, 1);
  const std::vector<int> rings = geometry::RingsFrom(neighbours, {7});
  for (int v = 0; v < fade.size(); ++v) EXPECT_DOUBLE_EQ(fade[v], rings[v] == 0 ? 0.2 : rings[v] == 1 ? 0.6 : 1.0);
}

TEST(GradientScaling, RefusesScalesOfAnotherMesh) {
  const Head head;
  testing::ExpectError([&] { GradientScaling(head.mesh, {3}).Rebuild(Points::Zero(4, 3)); },
                       "log scales of 4 vertices");
}

}  // namespace
}  // namespace daumier::faces
