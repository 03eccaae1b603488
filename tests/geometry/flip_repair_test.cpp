#include "geometry/flip_repair.h"

#include "core/random.h"
#include "geometry/flips.h"
#include "geometry/normals.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

using testing::ExpectError;

const Triangles kOneTriangle = (Triangles(1, 3) << 0, 1, 2).finished();
const Points kCorner = (Points(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
const Points kNormal = AreaNormals({kCorner, kOneTriangle});

TEST(FlipRepair, OneTriangleByHand) {
  const FlipRepair repair(kOneTriangle, 3);
  Points displacement = Points::Zero(3, 3);
  displacement(2, 1) = -3;  // Twice the area is 1 - 3 t, which is 0.1 at t = 0.3; the mean moves by -1.
  const SurfaceDefects defects = repair.Find(kCorner, kNormal, displacement);
  EXPECT_EQ(defects.turned, std::vector<int>{0});
  EXPECT_TRUE(defects.folded.empty());
  EXPECT_TRUE(repair.Relax(kCorner, kNormal, defects, 1, displacement).empty());
  const Points expected = (Points(3, 3) << 0, -0.7, 0, 0, -0.7, 0, 0, -1.6, 0).finished();
  EXPECT_LT((displacement - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FlipRepair, WhatIsNotTurnedOverStays) {
  const FlipRepair repair(kOneTriangle, 3);
  Points displacement = Points::Zero(3, 3);
  displacement(2, 1) = -0.99;
  const Points before = displacement;
  EXPECT_TRUE(repair.Find(kCorner, kNormal, displacement).empty());
  EXPECT_TRUE(repair.Relax(kCorner, kNormal, {}, 10, displacement).empty());
  EXPECT_EQ(displacement, before);
}

TEST(FlipRepair, WhatTheSurfaceHasTurnedOverDoesNotCount) {
  const FlipRepair repair(kOneTriangle, 3);
  const Points turned = kCorner * Eigen::Vector3d(1, -1, 1).asDiagonal();
  EXPECT_TRUE(repair.Find(turned, kNormal, Points::Zero(3, 3)).empty());
}

TEST(FlipRepair, TurnsAddUpFromTheReference) {
  const FlipRepair repair(kOneTriangle, 3);
  const auto tilted = [](double degrees) {  // About the x axis.
    Points points = kCorner;
    points.row(2) << 0, std::cos(degrees * M_PI / 180), std::sin(degrees * M_PI / 180);
    return points;
  };
  EXPECT_TRUE(repair.Find(tilted(60), AreaNormals({tilted(60), kOneTriangle}), tilted(120) - tilted(60)).empty());
  EXPECT_EQ(repair.Find(tilted(60), kNormal, tilted(120) - tilted(60)).turned, std::vector<int>{0});
}

TEST(FlipRepair, AFoldedEdgeIsOpened) {
  // Two triangles, flat on the surface; the fourth corner is turned about the common edge by 170 degrees, which does not
  // turn the triangle over if its reference lies at 100 degrees.
  const Triangles triangles = (Triangles(2, 3) << 0, 1, 2, 1, 0, 3).finished();
  const auto bent = [](double degrees) {
    const double angle = degrees * M_PI / 180;
    return Points((Points(4, 3) << 0, 0, 0, 1, 0, 0, 0.5, 1, 0, 0.5, -std::cos(angle), std::sin(angle)).finished());
  };
  const FlipRepair repair(triangles, 4);
  const Points surface = bent(100), normals = AreaNormals({surface, triangles});
  Points displacement = bent(170) - surface;
  const SurfaceDefects defects = repair.Find(surface, normals, displacement);
  EXPECT_TRUE(defects.turned.empty());
  EXPECT_EQ(defects.folded, std::vector<int>{0});
  EXPECT_TRUE(repair.Find(bent(170), normals, Points::Zero(4, 3)).empty()) << "a fold of the surface itself";
  EXPECT_TRUE(repair.Find(surface, AreaNormals({bent(170), triangles}), displacement).empty()) << "of the reference";
  EXPECT_TRUE(repair.Relax(surface, normals, defects, 1, displacement).empty());
  EXPECT_FALSE(displacement.isZero(1e-3));
}

TEST(FlipRepair, ATornSheetIsTurnedBackNextToTheTear) {
  const int n = 12;
  const TriangleMesh sheet = testing::FlatSheet(n);
  const FlipRepair repair(sheet.triangles, int(sheet.vertices.rows()));
  Points displacement = Points::Zero(sheet.vertices.rows(), 3);
  for (Eigen::Index v = 0; v < displacement.rows(); ++v)  // A row of vertices moves over its neighbours.
    if (std::abs(sheet.vertices(v, 0) - 0.5) < 1e-9) displacement(v, 0) = 1.5 / n;
  const SurfaceDefects defects = repair.Find(sheet.vertices, AreaNormals(sheet), displacement);
  EXPECT_FALSE(defects.turned.empty());
  Points relaxed = displacement;
  EXPECT_TRUE(repair.Relax(sheet.vertices, AreaNormals(sheet), defects, 100, relaxed).empty());
  EXPECT_EQ(CountFlippedTriangles(sheet.vertices, sheet.vertices + relaxed, sheet.triangles), 0);
  EXPECT_TRUE(relaxed.rightCols<2>().isZero(0)) << "a displacement along x stays one";
  for (Eigen::Index v = 0; v < displacement.rows(); ++v)
    if (sheet.vertices(v, 0) < 0.3) {
      EXPECT_EQ(relaxed.row(v), displacement.row(v));
    }
}

TEST(FlipRepair, RandomMovesOfASphereAreTurnedBack) {
  const TriangleMesh sphere = testing::Sphere(1, 3);
  const FlipRepair repair(sphere.triangles, int(sphere.vertices.rows()));
  Points displacement = Points::Zero(sphere.vertices.rows(), 3);
  Rng rng(5);
  for (Eigen::Index v = 0; v < displacement.rows(); v += 4)
    for (int axis = 0; axis < 3; ++axis) displacement(v, axis) = 0.25 * rng.Normal();
  const SurfaceDefects defects = repair.Find(sphere.vertices, AreaNormals(sphere), displacement);
  EXPECT_GT(defects.turned.size(), 30u);
  EXPECT_EQ(defects.turned, FlippedTriangles(sphere.vertices, sphere.vertices + displacement, sphere.triangles));
  EXPECT_TRUE(repair.Relax(sphere.vertices, AreaNormals(sphere), defects, 200, displacement).empty());
  EXPECT_EQ(CountFlippedTriangles(sphere.vertices, sphere.vertices + displacement, sphere.triangles), 0);
}

TEST(FlipRepair, RefusesOtherShapes) {
  ExpectError([] { FlipRepair(kOneTriangle, 2); }, "2");
  const FlipRepair repair(kOneTriangle, 3);
  ExpectError([&] { repair.Find(kCorner, kNormal, Points::Zero(2, 3)); }, "3 and 2 vertices, expected 3");
  ExpectError([&] { repair.Find(kCorner, Points::Zero(2, 3), kCorner); }, "2 normals, expected 1");
}

}  // namespace
}  // namespace daumier::geometry
