#include "systems/sketch/silhouette_pull.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::sketch {
namespace {

/// Points (0, y) .. (10, y), a pixel apart, each a vertex, the first is `first`.
SurfaceLine StraightLine(double y, int first = 0) {
  SurfaceLine line;
  for (int i = 0; i <= 10; ++i) {
    line.points.emplace_back(i, y);
    line.vertices.push_back({first + i, first + i});
  }
  return line;
}

/// A circle of 36 vertices about the origin.
SurfaceLine Circle(double radius) {
  SurfaceLine line;
  for (int i = 0; i <= 36; ++i) {
    const double angle = M_PI * i / 18;
    line.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    line.vertices.push_back({i % 36, i % 36});
  }
  line.closed = true;
  return line;
}

TEST(VisibleSilhouettes, ThatOfASphereIsACircle) {
  const geometry::TriangleMesh sphere = testing::Sphere(2, 4);
  for (const View& view : {View{}, View{40, 0}, View{10, 70}}) {
    const render::Camera camera = ViewCamera(render::FrontalCamera({0, 0, 0}, 4, 256), {}, {0, 0, 0}, view);
    const std::vector<SurfaceLine> lines = VisibleSilhouettes(sphere, camera, VisibleSurface(sphere, camera));
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_TRUE(lines[0].closed);
    EXPECT_EQ(lines[0].points.front(), lines[0].points.back());
    for (const Eigen::Vector2d& point : lines[0].points) EXPECT_NEAR((point - Eigen::Vector2d(128, 128)).norm(), 64, 1);
  }
}

TEST(VisibleSilhouettes, EndWhereSomethingLiesInFront) {
  // A small sphere in front of the right half of a larger one.
  geometry::TriangleMesh both = testing::Sphere(2, 4);
  const geometry::TriangleMesh small = testing::Sphere(1.5, 4);
  const Eigen::Index count = both.vertices.rows();
  both.vertices.conservativeResize(2 * count, 3);
  both.vertices.bottomRows(count) = small.vertices.rowwise() + Eigen::RowVector3d(2, 0, 6);
  geometry::Triangles triangles(2 * both.triangles.rows(), 3);
  triangles << both.triangles, small.triangles.array() + int(count);
  both.triangles = triangles;
  const render::Camera camera = render::FrontalCamera({0, 0, 0}, 4, 256);
  const std::vector<SurfaceLine> lines = VisibleSilhouettes(both, camera, VisibleSurface(both, camera));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NE(lines[0].closed, lines[1].closed);
  const SurfaceLine& cut = lines[0].closed ? lines[1] : lines[0];
  const double arc = 2 * std::acos(1 - 1.5 * 1.5 / 8) * 2 * 32;  // Of the large circle within the small one, pixels.
  EXPECT_NEAR(datasets::LengthOf(cut.points), 2 * M_PI * 64 - arc, 12);
  for (const Eigen::Vector2d& point : cut.points) EXPECT_GT((point - Eigen::Vector2d(192, 128)).norm(), 48 - 6);
}

TEST(DefinedSilhouette, JoinsTheCurvesOfTheAnnotation) {
  const faces::FaceTemplate face = testing::SyntheticFace();
  const render::Camera camera = render::SideCamera({0, 0, 0}, 15, 256);
  const SurfaceLine line =
      DefinedSilhouette(face.annotation, faces::View::kSide, render::Project(camera, face.neutral));
  size_t num_vertices = 0;
  for (const faces::FeatureCurve& curve : face.annotation.curves)
    if (curve.kind == "side_silhouette") num_vertices += curve.vertices.size();
  ASSERT_EQ(line.points.size(), num_vertices);
  for (size_t i = 1; i < line.points.size(); ++i)
    EXPECT_LT(line.points[i].y(), line.points[i - 1].y()) << "from the neck up, the mouth between its two curves";
  EXPECT_FALSE(line.closed);
  const SurfaceLine frontal = DefinedSilhouette(face.annotation, faces::View::kFrontal, face.neutral);
  EXPECT_TRUE(frontal.closed);
  EXPECT_EQ(frontal.points.front(), frontal.points.back());
  EXPECT_TRUE(DefinedSilhouette({}, faces::View::kSide, face.neutral).points.empty());
}

TEST(PullToStroke, PointsBetweenTheEndsMoveByTheirShareOfTheLength) {
  const CanvasPoints stroke = {{2, 3}, {8, 3}};
  for (const CanvasPoints& drawn : {stroke, datasets::Reversed(stroke)}) {
    const auto pull = PullToStroke({StraightLine(0)}, drawn, 5);
    ASSERT_TRUE(pull);
    EXPECT_EQ(pull->vertices, (std::vector<int>{2, 3, 4, 5, 6, 7, 8}));
    EXPECT_LT((pull->moves.rowwise() - Eigen::RowVector2d(0, 3)).cwiseAbs().maxCoeff(), 1e-12);
  }
  // A longer way: the points lie on it at equal distances.
  const auto bent = PullToStroke({StraightLine(0)}, {{2, 0}, {2, 3}, {8, 3}, {8, 0}}, 5);
  ASSERT_TRUE(bent);
  EXPECT_EQ(bent->vertices.front(), 2);
  EXPECT_LT((bent->moves.row(1) - Eigen::RowVector2d(-1, 2)).norm(), 1e-12) << "vertex 3, a sixth of 12 pixels";
  EXPECT_LT((bent->moves.row(3) - Eigen::RowVector2d(0, 3)).norm(), 1e-12) << "vertex 5, the middle";
}

TEST(PullToStroke, TakesTheNearestLineWithinReach) {
  const std::vector<SurfaceLine> lines = {StraightLine(0), StraightLine(10, 100)};
  const CanvasPoints stroke = {{2, 6}, {8, 6}};
  const auto pull = PullToStroke(lines, stroke, 8);
  ASSERT_TRUE(pull);
  EXPECT_EQ(pull->vertices.front(), 102);
  EXPECT_DOUBLE_EQ(pull->distance, 4);
  EXPECT_FALSE(PullToStroke(lines, stroke, 3));
  EXPECT_FALSE(PullToStroke({}, stroke, 8));
  EXPECT_FALSE(PullToStroke(lines, {{20, 0}, {30, 0}}, 100)) << "the nearest place to both ends is the same";
}

TEST(PullToStroke, OfAClosedLineThePartThatIsNear) {
  const CanvasPoints stroke = [] {  // An arc across the place where the circle begins.
    CanvasPoints arc;
    for (int i = -5; i <= 5; ++i) arc.emplace_back(12 * std::cos(M_PI * i / 18), 12 * std::sin(M_PI * i / 18));
    return arc;
  }();
  for (const CanvasPoints& drawn : {stroke, datasets::Reversed(stroke)}) {
    const auto pull = PullToStroke({Circle(10)}, drawn, 5);
    ASSERT_TRUE(pull);
    ASSERT_EQ(pull->vertices.front(), 0);
    EXPECT_LT((pull->moves.row(0) - Eigen::RowVector2d(2, 0)).norm(), 0.02);
    EXPECT_LE(pull->vertices.size(), 11u);
    EXPECT_GE(pull->vertices.size(), 9u);
    for (Eigen::Index k = 0; k < pull->moves.rows(); ++k) EXPECT_NEAR(pull->moves.row(k).norm(), 2, 0.05);
  }
}

TEST(PullToStroke, BothVerticesOfAnEdgeMoveByTheMeanOfTheirPoints) {
  SurfaceLine line;
  line.points = {{0, 0}, {1, 0}, {2, 0}};
  line.vertices = {{4, 7}, {7, 9}, {9, 9}};
  const auto pull = PullToStroke({line}, {{0, 1}, {2, 3}}, 5);
  ASSERT_TRUE(pull);
  EXPECT_EQ(pull->vertices, (std::vector<int>{4, 7, 9}));
  const Eigen::MatrixX2d expected = (Eigen::MatrixX2d(3, 2) << 0, 1, 0, 1.5, 0, 2.5).finished();
  EXPECT_LT((pull->moves - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(PullToStroke, RefusesWhatIsNoStroke) {
  testing::ExpectError([] { PullToStroke({StraightLine(0)}, {}, 5); }, "shorter than a pixel");
  testing::ExpectError([] { PullToStroke({StraightLine(0)}, {{1, 1}}, 5); }, "shorter than a pixel");
  testing::ExpectError([] { PullToStroke({StraightLine(0)}, {{1, 1}, {NAN, 0}}, 5); }, "not finite");
}

}  // namespace
}  // namespace daumier::sketch
