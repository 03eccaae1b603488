#include "render/contour_strokes.h"

#include "geometry/submesh.h"
#include "geometry/topology.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace daumier::render {
namespace {

using geometry::TriangleMesh;

constexpr double kFeatureSize = 0.1;
const Camera kTilted = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 0, 40);

std::vector<Stroke> OfTorus(const ContourOptions& options, const Camera& camera = kTilted) {
  const ContourSurface torus = MakeContourSurface(testing::Torus(3, 1, 120, 60));
  return SuggestiveStrokes(torus, Visibility(camera, torus.mesh, 0.1), kFeatureSize, options, 4);
}

double Length(const Stroke& stroke) {
  double length = 0;
  for (size_t i = 1; i < stroke.points.size(); ++i)
    length += std::hypot(stroke.points[i][0] - stroke.points[i - 1][0], stroke.points[i][1] - stroke.points[i - 1][1]);
  return length;
}

TEST(OccludingStrokes, OfASphereAreOneCircleOfItsRadius) {
  const ContourSurface sphere = MakeContourSurface(testing::Sphere(2, 5));
  const auto strokes = OccludingStrokes(sphere, Visibility(kTilted, sphere.mesh, 0.05), {}, 7);
  ASSERT_EQ(strokes.size(), 1u);
  EXPECT_EQ(strokes[0].kind, 7);
  EXPECT_EQ(strokes[0].points.front(), strokes[0].points.back());
  const double radius = 2 * 256 / 10.0;
  for (const auto& [x, y] : strokes[0].points) EXPECT_NEAR(std::hypot(x - 128, y - 128), radius, 0.5);
}

TEST(OccludingStrokes, HiddenPartsAreCutOff) {
  // Seen flat from the side, the far rim of the torus' hole lies behind its near side.
  const ContourSurface torus = MakeContourSurface(testing::Torus(3, 1, 120, 60));
  const Camera camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 0, 75);
  const TriangleMesh nothing{torus.mesh.vertices, geometry::Triangles(0, 3)};
  const auto length = [](const std::vector<Stroke>& strokes) {
    return std::accumulate(strokes.begin(), strokes.end(), 0.0,
                           [](double sum, const Stroke& stroke) { return sum + Length(stroke); });
  };
  const double all = length(OccludingStrokes(torus, Visibility(camera, nothing, 0), {}, 0));
  const double seen = length(OccludingStrokes(torus, Visibility(camera, torus.mesh, 0.1), {}, 0));
  EXPECT_LT(seen, 0.95 * all);
  EXPECT_GT(seen, 0.5 * all);
}

TEST(SuggestiveStrokes, NoneIsShorterThanTheMinimum) {
  ContourOptions options{.low = 0, .high = 0, .min_angle = 0, .min_length = 0};
  const size_t num_all = OfTorus(options).size();
  ASSERT_GT(num_all, 0u);
  options.min_length = 20;
  for (const Stroke& stroke : OfTorus(options)) {
    EXPECT_GT(Length(stroke), 18) << "smoothing takes a little";
    EXPECT_EQ(stroke.kind, 4);
  }
  options.min_length = 250;
  EXPECT_LT(OfTorus(options).size(), num_all);
}

TEST(SuggestiveStrokes, HysteresisKeepsALineWholeOrDropsIt) {
  ContourOptions options{.low = 1e-4, .high = 1e-4, .min_angle = 10, .min_length = 5};
  const auto all = OfTorus(options);
  ASSERT_FALSE(all.empty());
  size_t last = all.size();
  for (const double high : {1e-3, 1e-2, 1e-1, 1.0, 10.0}) {
    options.high = high;
    const auto kept = OfTorus(options);
    EXPECT_LE(kept.size(), last);
    last = kept.size();
    for (const Stroke& stroke : kept) {
      const bool is_one_of_all =
          std::any_of(all.begin(), all.end(), [&](const Stroke& other) { return other.points == stroke.points; });
      EXPECT_TRUE(is_one_of_all);
    }
  }
  options.low = 20;
  testing::ExpectError([&] { OfTorus(options); }, "below the lower one");
}

TEST(SuggestiveStrokes, NoneLiesWhereTheSurfaceFacesTheViewer) {
  EXPECT_EQ(OfTorus({.low = 0, .high = 0, .min_angle = 90, .min_length = 0}).size(), 0u);
}

TEST(ContourSurface, DependsOnNothingFartherThanItsRings) {
  TriangleMesh torus = testing::Torus(3, 1, 60, 30);
  torus.vertices.array() += 0.03 * (torus.vertices.array() * 5).sin();
  const auto neighbours = geometry::VertexNeighbours(torus.triangles, int(torus.vertices.rows()));
  const std::vector<int> region = geometry::VerticesWithin(neighbours, {17}, 4);
  const auto map =
      geometry::MapKept(geometry::VerticesWithin(neighbours, region, kContourRings), int(torus.vertices.rows()));
  const ContourSurface whole = MakeContourSurface(torus), part = MakeContourSurface(geometry::Submesh(torus, map));
  for (const int v : region) {
    const int w = map.new_from_old[size_t(v)];
    EXPECT_DOUBLE_EQ(whole.curvatures.k1[v], part.curvatures.k1[w]);
    EXPECT_LT((whole.derivatives.row(v) - part.derivatives.row(w)).norm(),
              1e-9 * (1 + whole.derivatives.row(v).norm()));
  }
}

TEST(SuggestiveStrokes, MarksSayWhereLinesAreLookedFor) {
  const ContourSurface torus = MakeContourSurface(testing::Torus(3, 1, 120, 60));
  const Visibility visibility(kTilted, torus.mesh, 0.1);
  const ContourOptions options{.low = 0, .high = 0, .min_angle = 0, .min_length = 0};
  const auto num_triangles = size_t(torus.mesh.triangles.rows());
  const auto strokes = [&](const std::vector<bool>& is_drawn) {
    return SuggestiveStrokes(torus, visibility, kFeatureSize, options, 0, is_drawn).size();
  };
  EXPECT_EQ(strokes(std::vector<bool>(num_triangles, false)), 0u);
  EXPECT_EQ(strokes(std::vector<bool>(num_triangles, true)), strokes({}));
  testing::ExpectError([&] { strokes({true}); }, "1 marks");
}

TEST(DrawContours, SeparatesOccludingFromSuggestiveContoursAndDoesNotDependOnTheUnit) {
  TriangleMesh torus = testing::Torus(3, 1, 120, 60);
  const ContourOptions options{.low = 0, .high = 0, .min_angle = 5, .min_length = 5};
  const auto strokes = DrawContours(torus, kTilted, options);
  int num_of_kind[3] = {0, 0, 0};
  for (const Stroke& stroke : strokes) ++num_of_kind[stroke.kind];
  EXPECT_GE(num_of_kind[0], 2) << ContourKinds()[0];
  EXPECT_GE(num_of_kind[1], 1) << ContourKinds()[1];
  EXPECT_EQ(num_of_kind[2], 0) << "a torus is closed";
  torus.vertices *= 100;
  const auto large = DrawContours(torus, TurnedCamera(Eigen::Vector3d::Zero(), 500, 256, 0, 40), options);
  ASSERT_EQ(large.size(), strokes.size());
  for (size_t s = 0; s < large.size(); ++s) EXPECT_NEAR(large[s].points[0][0], strokes[s].points[0][0], 1e-2);
}

TEST(DrawContours, DrawsTheBorderOfAnOpenSurfaceAsOneLoop) {
  const TriangleMesh dome =
      testing::Sheet(20, [](double x, double y) { return 0.3 * std::sin(3 * x) * std::sin(3 * y); });
  const Frame frame = FrameOf(dome.vertices);
  const auto strokes = DrawContours(dome, FrontalCamera(frame.centre, frame.half_height, 256));
  const auto is_border = [](const Stroke& stroke) { return ContourKinds()[size_t(stroke.kind)] == "border"; };
  EXPECT_EQ(std::count_if(strokes.begin(), strokes.end(), is_border), 1);
  const auto border = std::find_if(strokes.begin(), strokes.end(), is_border);
  EXPECT_EQ(border->points.size(), 81u);
  EXPECT_EQ(border->points.front(), border->points.back());
}

}  // namespace
}  // namespace daumier::render
