#include "geometry/principal_curvature.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/rtsc_reference.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>

namespace daumier::geometry {
namespace {

TEST(PrincipalCurvature, OfASphereIsOneOverItsRadius) {
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(testing::Sphere(2, 4));
  EXPECT_LT((curvatures.k1.array() - 0.5).abs().maxCoeff(), 0.01);
  EXPECT_LT((curvatures.k2.array() - 0.5).abs().maxCoeff(), 0.01);
}

TEST(PrincipalCurvature, OfATorusIsInClosedForm) {
  constexpr int kAround = 160, kAcross = 80;
  const TriangleMesh torus = testing::Torus(3, 1, kAround, kAcross);
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(torus);
  const auto derivatives = ComputeCurvatureDerivatives(torus, curvatures);
  for (int j = 0; j < kAcross; ++j) {
    const int v = 7 * kAcross + j;
    const double angle = 2 * std::numbers::pi * j / kAcross, radius = 3 + std::cos(angle);
    EXPECT_NEAR(curvatures.k1[v], 1, 0.01);
    EXPECT_NEAR(curvatures.k2[v], std::cos(angle) / radius, 0.01);
    // Along the small circle, which direction1 follows, only k2 changes: by -3 sin / radius^2 a centimetre.
    const double turn = 2 * std::numbers::pi * 7 / kAround;
    const Vector3 upwards(-std::sin(angle) * std::cos(turn), -std::sin(angle) * std::sin(turn), std::cos(angle));
    const double side = upwards.dot(Vector3(curvatures.direction1.row(v)));
    EXPECT_NEAR(std::abs(side), 1, 0.01);
    EXPECT_NEAR(derivatives(v, 2) * side, -3 * std::sin(angle) / (radius * radius), 0.02);
    for (const int still : {0, 1, 3}) EXPECT_NEAR(derivatives(v, still), 0, 0.02);
  }
}

/// With s = x^2 / a^4 + y^2 / b^4 + z^2 / c^4: K = 1 / (a b c s)^2, H = (a^2 + b^2 + c^2 - |p|^2) / (2 (a b c)^2
/// s^(3/2)).
TEST(PrincipalCurvature, OfAnEllipsoidIsInClosedForm) {
  const Vector3 axes(3, 2, 1.5);
  TriangleMesh ellipsoid = testing::Sphere(1, 6);
  ellipsoid.vertices = ellipsoid.vertices * axes.asDiagonal();
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(ellipsoid);
  const double volume2 = std::pow(axes.prod(), 2);
  const auto num_vertices = ellipsoid.vertices.rows();
  Eigen::VectorXd mean_errors(num_vertices), gaussian_errors(num_vertices);  // Relative.
  for (Eigen::Index v = 0; v < num_vertices; ++v) {
    const Vector3 p = ellipsoid.vertices.row(v);
    const double s = (p.array() / axes.array().square()).square().sum();
    const double gaussian = 1 / (volume2 * s * s);
    const double mean = (axes.squaredNorm() - p.squaredNorm()) / (2 * volume2 * std::pow(s, 1.5));
    mean_errors[v] = std::abs(0.5 * (curvatures.k1[v] + curvatures.k2[v]) / mean - 1);
    gaussian_errors[v] = std::abs(curvatures.k1[v] * curvatures.k2[v] / gaussian - 1);
  }
  EXPECT_LT(mean_errors.mean(), 0.01);
  EXPECT_LT(gaussian_errors.mean(), 0.02);
  EXPECT_LT(mean_errors.maxCoeff(), 0.06) << "where the triangles change their shape";
  EXPECT_LT(gaussian_errors.maxCoeff(), 0.12);
}

/// The graph z = a x^2 / 2 + b y^2 / 2 + c x^3 / 6 at the origin: k = a, b and C_111 = c, but for the sign, since the
/// graph is convex downwards.
TEST(PrincipalCurvature, OfAGraphIsItsSecondAndThirdDerivative) {
  const TriangleMesh graph = testing::Sheet(80, [](double x, double y) {
    const double u = x - 0.5, v = y - 0.5;
    return 0.9 * u * u + 0.2 * v * v + 0.5 * u * u * u;
  });
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(graph);
  const int centre = 40 * 81 + 40;
  EXPECT_NEAR(curvatures.k1[centre], -1.8, 0.02);
  EXPECT_NEAR(curvatures.k2[centre], -0.4, 0.02);
  const double side = curvatures.direction1(centre, 0);
  EXPECT_NEAR(std::abs(side), 1, 1e-3);
  EXPECT_NEAR(ComputeCurvatureDerivatives(graph, curvatures)(centre, 0) * side, -3.0, 0.05);
}

TEST(PrincipalCurvature, TurnsWithTheSurface) {
  TriangleMesh torus = testing::Torus(3, 1, 24, 16);
  const PrincipalCurvatures before = ComputePrincipalCurvatures(torus);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  torus.vertices = torus.vertices * turn.transpose();
  const PrincipalCurvatures after = ComputePrincipalCurvatures(torus);
  EXPECT_LT((before.k1 - after.k1).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((before.k2 - after.k2).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(PrincipalCurvature, DirectionsAreAnOrthonormalFrame) {
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(testing::Torus(3, 1, 24, 16));
  for (Eigen::Index v = 0; v < curvatures.k1.size(); ++v) {
    const Vector3 n = curvatures.normals.row(v), a = curvatures.direction1.row(v), b = curvatures.direction2.row(v);
    EXPECT_NEAR(a.norm(), 1, 1e-12);
    EXPECT_NEAR(a.dot(n), 0, 1e-12);
    EXPECT_LT((n.cross(a) - b).norm(), 1e-12);
    EXPECT_GE(std::abs(curvatures.k1[v]), std::abs(curvatures.k2[v]));
  }
}

TEST(SolveLdlt, SolvesAndRefusesWhatIsSingular) {
  Eigen::Matrix3d w;
  w << 4, 2, 0, 2, 5, 3, 0, 3, 9;
  const Eigen::Vector3d x(1, -2, 3);
  Eigen::Vector3d solved = w * x;
  ASSERT_TRUE(SolveLdlt(w, solved));
  EXPECT_LT((solved - x).norm(), 1e-12);
  w.setOnes();
  EXPECT_FALSE(SolveLdlt(w, solved));
}

TEST(SurfaceCurvature, IsBothAtOnce) {
  const TriangleMesh torus = testing::Torus(3, 1, 40, 20);
  const SurfaceCurvature both = ComputeSurfaceCurvature(torus);
  const PrincipalCurvatures principal = ComputePrincipalCurvatures(torus);
  EXPECT_EQ(both.principal.k1, principal.k1);
  EXPECT_EQ(both.derivatives, ComputeCurvatureDerivatives(torus, principal));
}

TEST(PrincipalCurvature, RefusesCurvaturesOfAnotherMesh) {
  const TriangleMesh sphere = testing::Sphere(1, 1);
  testing::ExpectError([&] { ComputeCurvatureDerivatives(testing::Sphere(1, 2), ComputePrincipalCurvatures(sphere)); },
                       "curvatures of 18 vertices for a mesh of 66");
}

TEST(PrincipalCurvature, AgreesWithTheReferenceProgramOnceItsFaultIsInjected) {
  const auto reference = testing::RtscReference::Load("default");
  if (!reference) GTEST_SKIP() << "no golden files next to the checkout";
  const PrincipalCurvatures curvatures = ComputePrincipalCurvatures(reference->mesh, testing::SolveWithStalePivot);
  const auto derivatives = ComputeCurvatureDerivatives(reference->mesh, curvatures);
  const auto& rows = reference->rows;
  using testing::ShareThatAgrees;
  EXPECT_LT((curvatures.normals - rows.middleCols<3>(3)).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_GE(ShareThatAgrees(curvatures.k1, rows.col(6)), 0.99);
  EXPECT_GE(ShareThatAgrees(curvatures.k2, rows.col(7)), 0.99);
  // Directions have no sign, and so the derivatives along them have none either.
  for (int entry = 0; entry < 4; ++entry)
    EXPECT_GE(ShareThatAgrees(derivatives.col(entry).cwiseAbs(), rows.col(14 + entry).cwiseAbs()), 0.99) << entry;
}

}  // namespace
}  // namespace daumier::geometry
