#include "systems/sketch/view_selection.h"

#include "geometry/normals.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/refinement_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::sketch {
namespace {

using testing::ExpectError;
using testing::RefinementSubject;

constexpr View kSelectionViews[] = {{0, 0}, {-90, 0}, {35, 20}, {180, -10}};

render::Camera FrontOfOrigin() {
  return render::FrontalCamera({0, 0, 0}, 4, 256);  // 32 pixels a cm.
}

geometry::Adjacency NeighboursOf(const geometry::TriangleMesh& mesh) {
  return geometry::VertexNeighbours(mesh.triangles, int(mesh.vertices.rows()));
}

/// A flat sheet of 11 x 11 vertices, 10 pixels apart, the first at (50, 150) and the last at (150, 50).
struct FlatCase {
  FlatCase() : mesh(testing::FlatSheet(10)), camera(render::FrontalCamera({0.5, 0.5, 0}, 1, 200)) {}
  std::vector<int> Vertices(int first_i, int last_i, int first_j, int last_j) const {
    std::vector<int> vertices;
    for (int j = first_j; j <= last_j; ++j)
      for (int i = first_i; i <= last_i; ++i) vertices.push_back(11 * j + i);
    return vertices;
  }
  geometry::TriangleMesh mesh;
  render::Camera camera;
  VisibleSurface surface{mesh, camera};
  geometry::Adjacency neighbours = NeighboursOf(mesh);
  Eigen::VectorXd areas = geometry::VertexAreas(mesh);
};

TEST(ViewCamera, IsTheFrontAndTheSideCamera) {
  const Eigen::Vector3d pivot(0.3, 1, -2), point(1, 2, 3);
  const render::Camera canvas = render::FrontalCamera(pivot, 4, 256);
  const auto seen = [&](const render::Camera& camera) {
    return render::Project(camera, point.transpose()).row(0).head<2>().eval();
  };
  EXPECT_LT((seen(ViewCamera(canvas, {}, pivot, {})) - seen(canvas)).norm(), 1e-9);
  EXPECT_LT((seen(ViewCamera(canvas, {}, pivot, {-90, 0})) - seen(render::SideCamera(pivot, 4, 256))).norm(), 1e-9);
  EXPECT_LT(
      (seen(ViewCamera(canvas, {}, pivot, {25, -40})) - seen(render::TurnedCamera(pivot, 4, 256, 25, -40))).norm(),
      1e-9);
}

TEST(ViewCamera, HasThePixelsOfTheSheet) {
  const render::Camera canvas = render::FrontalCamera({0, 1, 0}, 5, 256);
  const render::Placement canvas_from_sheet{0.4, {12, -7}, 8};
  const Eigen::Vector3d point(1, 2, 3), pivot(0, 3, 1);
  const auto seen = [](const render::Camera& camera, const Eigen::Vector3d& p) -> Eigen::Vector2d {
    return render::Project(camera, p.transpose()).row(0).head<2>();
  };
  const render::Camera front = ViewCamera(canvas, canvas_from_sheet, pivot, {});
  EXPECT_LT((seen(front, point) - render::ToSheet(canvas_from_sheet, seen(canvas, point))).norm(), 1e-9);
  const render::Camera turned = ViewCamera(canvas, canvas_from_sheet, pivot, {50, 10});
  EXPECT_LT((seen(turned, pivot) - seen(front, pivot)).norm(), 1e-9) << "the pivot stays";
  EXPECT_NEAR(turned.camera_from_world.determinant(), 1, 1e-12);
}

TEST(ViewCamera, RefusesWhatIsNoView) {
  const render::Camera canvas = FrontOfOrigin();
  ExpectError([&] { ViewCamera(canvas, {}, {0, 0, 0}, {NAN, 0}); }, "expected finite ones");
  ExpectError([&] { ViewCamera(canvas, {}, {0, 0, 0}, {0, INFINITY}); }, "expected finite ones");
  ExpectError([&] { ViewCamera(render::WithPerspective(canvas, 50), {}, {0, 0, 0}, {}); }, "in perspective");
}

TEST(VisibleSurface, TheFarSideOfASphereIsHidden) {
  const geometry::TriangleMesh sphere = testing::Sphere(2, 4);
  for (const View& view : kSelectionViews) {
    const render::Camera camera = ViewCamera(FrontOfOrigin(), {}, {0, 0, 0}, view);
    const VisibleSurface surface(sphere, camera);
    const Eigen::VectorXd cosine = -(sphere.vertices * camera.camera_from_world.row(2).transpose()) / 2;
    for (size_t v = 0; v < surface.is_visible().size(); ++v) {
      if (cosine[Eigen::Index(v)] > 0.15) {
        EXPECT_TRUE(surface.is_visible()[v]);
      }
      if (cosine[Eigen::Index(v)] < -0.15) {
        EXPECT_FALSE(surface.is_visible()[v]) << "edges are 0.1 long on a radius of 1";
      }
    }
    const CanvasPoints around = {{0, 0}, {256, 0}, {256, 256}, {0, 256}};
    for (const int v : EnclosedRegion(surface, NeighboursOf(sphere), geometry::VertexAreas(sphere), around))
      EXPECT_GT(cosine[v], -0.15);
    for (const int v : VisibleNear(surface, {{0, 128}, {256, 128}}, 40)) EXPECT_GT(cosine[v], -0.15);
  }
}

TEST(VisibleSurface, RefusesWhatItCannotSee) {
  geometry::TriangleMesh sphere = testing::Sphere(2, 2);
  ExpectError([&] { VisibleSurface(sphere, render::WithPerspective(FrontOfOrigin(), 50)); }, "in perspective");
  sphere.vertices(3, 1) = NAN;
  ExpectError([&] { VisibleSurface(sphere, FrontOfOrigin()); }, "not all finite");
  ExpectError([&] { VisibleSurface({}, FrontOfOrigin()); }, "a surface of 0 vertices");
}

TEST(EnclosedRegion, IsWhatLiesInTheStroke) {
  const FlatCase flat;
  // Vertices 2..6 across and 3..7 up lie between the lines.
  const std::vector<int> expected = flat.Vertices(2, 6, 3, 7);
  const CanvasPoints closed = {{65, 75}, {115, 75}, {115, 125}, {65, 125}, {65, 75}};
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, closed), expected);
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, datasets::Reversed(closed)), expected);
  const CanvasPoints open(closed.begin(), closed.end() - 1);
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, open), expected) << "closed by its chord";
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, datasets::Joined(closed, open)), expected)
      << "drawn twice";
  CanvasPoints overshot = closed;
  overshot.insert(overshot.end(), {{90, 75}, {90, 95}});  // The end goes into the loop.
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, overshot), expected);
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, datasets::Resampled(closed, 5000)), expected);
}

TEST(EnclosedRegion, IsConnected) {
  const FlatCase flat;
  // An eight whose loops enclose 4 x 3 and 9 vertices and cross between vertices that are no neighbours.
  const CanvasPoints eight = {{55, 65}, {95, 65}, {95, 95}, {115, 125}, {135, 125}, {135, 95}, {95, 94}, {55, 95}};
  EXPECT_EQ(EnclosedRegion(flat.surface, flat.neighbours, flat.areas, eight), flat.Vertices(1, 4, 6, 8))
      << "the larger loop";
}

TEST(EnclosedRegion, HiddenPocketsOfAFaceBelongToIt) {
  const RefinementSubject subject;
  const geometry::TriangleMesh mesh{subject.face_template.neutral, subject.face_template.triangles};
  const VisibleSurface surface(mesh, subject.Camera({}));
  const geometry::Adjacency neighbours = NeighboursOf(mesh);
  const Eigen::VectorXd areas = geometry::VertexAreas(mesh);
  const auto hidden_in = [&](const CanvasPoints& stroke) {
    const std::vector<int> region = EnclosedRegion(surface, neighbours, areas, stroke);
    for (const int v : region) EXPECT_GT(mesh.vertices(v, 2), -3) << "not the back of the head";
    return std::ranges::count_if(region, [&](int v) { return !surface.is_visible()[size_t(v)]; });
  };
  EXPECT_GT(hidden_in(RefinementSubject::Loop(subject.Landmark(33, {}), 75, 40)), 400) << "nostrils";
  EXPECT_GT(hidden_in(RefinementSubject::Loop(subject.Landmark(62, {}), 65, 40)), 400) << "the inside of the lips";
  EXPECT_LT(hidden_in(RefinementSubject::Loop(subject.Cheek({}), 40, 40)), 10);
  hidden_in(RefinementSubject::Loop({256, 256}, 250, 250));
}

TEST(EnclosedRegion, RefusesStrokesThatMarkNothing) {
  const FlatCase flat;
  const auto region = [&](const CanvasPoints& stroke) {
    EnclosedRegion(flat.surface, flat.neighbours, flat.areas, stroke);
  };
  ExpectError([&] { region({}); }, "shorter than a pixel");
  ExpectError([&] { region({{1, 1}}); }, "shorter than a pixel");
  ExpectError([&] { region({{1, 1}, {NAN, 2}, {3, 3}}); }, "not finite");
  ExpectError([&] { region({{0, 0}, {40, 0}, {40, 40}, {0, 40}}); }, "draw it around a part of the face");
  ExpectError([&] { region({{0, 0}, {200, 200}}); }, "encloses no vertex");
}

TEST(VisibleNear, IsWhatLiesUnderTheBrush) {
  const FlatCase flat;
  EXPECT_EQ(VisibleNear(flat.surface, {{70, 110}}, 3), flat.Vertices(2, 2, 4, 4)) << "a dab";
  EXPECT_EQ(VisibleNear(flat.surface, {{70, 110}, {100, 110}}, 10.5), [&] {
    std::vector<int> vertices = flat.Vertices(2, 5, 3, 5);
    vertices.insert(vertices.begin() + 4, {11 * 4 + 1});
    vertices.insert(vertices.begin() + 9, {11 * 4 + 6});
    return vertices;
  }());
  EXPECT_TRUE(VisibleNear(flat.surface, {{10, 10}, {20, 10}}, 8).empty());
}

TEST(VisibleNear, RefusesWhatIsNoBrush) {
  const FlatCase flat;
  ExpectError([&] { VisibleNear(flat.surface, {}, 3); }, "has no point");
  ExpectError([&] { VisibleNear(flat.surface, {{NAN, 1}}, 3); }, "not finite");
  for (const double radius : {0.0, -1.0, double(NAN), double(INFINITY)})
    ExpectError([&] { VisibleNear(flat.surface, {{1, 1}}, radius); }, "expected a positive one");
}

}  // namespace
}  // namespace daumier::sketch
