#include "render/mesh_drawing.h"

#include "core/log.h"
#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace daumier::render {
namespace {

using geometry::PolygonMesh;
using testing::ExpectError;

const MeshView kTiltedView{.yaw_degrees = 17, .pitch_degrees = 40};
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// A torus in the plane of x and y that faces +z.
PolygonMesh TorusMesh() {
  const geometry::TriangleMesh torus = testing::Torus(3, 1, 60, 30);
  PolygonMesh mesh{.vertices = torus.vertices};
  mesh.corners.assign(torus.triangles.data(), torus.triangles.data() + torus.triangles.size());
  for (int end = 3; end <= torus.triangles.size(); end += 3) mesh.offsets.push_back(end);
  return mesh;
}

void AddTriangle(PolygonMesh& mesh, const geometry::Points& corners) {
  const auto begin = mesh.vertices.rows();
  mesh.vertices.conservativeResize(begin + 3, Eigen::NoChange);
  mesh.vertices.bottomRows(3) = corners;
  for (int k = 0; k < 3; ++k) mesh.corners.push_back(static_cast<int>(begin) + k);
  mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
}

/// Strokes as DrawMesh gives them, and how many warnings it logs.
struct Drawn {
  std::vector<Stroke> strokes;
  int num_warnings;
};
Drawn Draw(const PolygonMesh& mesh, const MeshView& view = kTiltedView) {
  const int before = log::NumWarnings();
  std::vector<Stroke> strokes = DrawMesh(mesh, view, {}, "a.obj");
  return {std::move(strokes), log::NumWarnings() - before};
}

void ExpectSameStrokes(const std::vector<Stroke>& strokes, const std::vector<Stroke>& expected, const char* what,
                       double tolerance_px = 1e-3) {
  ASSERT_EQ(strokes.size(), expected.size()) << what;
  for (size_t s = 0; s < strokes.size(); ++s) {
    EXPECT_EQ(strokes[s].kind, expected[s].kind) << what;
    ASSERT_EQ(strokes[s].points.size(), expected[s].points.size()) << what;
    for (size_t i = 0; i < strokes[s].points.size(); ++i) {
      for (const int k : {0, 1}) EXPECT_NEAR(strokes[s].points[i][k], expected[s].points[i][k], tolerance_px) << what;
    }
  }
}

TEST(DrawMesh, DrawsTheContoursOfAnUprightMesh) {
  const PolygonMesh mesh = TorusMesh();
  const geometry::TriangleMesh torus = testing::Torus(3, 1, 60, 30);
  const Frame frame = FrameOf(torus.vertices);
  const auto expected =
      DrawContours(torus, TurnedCamera(frame.centre, frame.half_height, kSketchCanvas, 17, 40), ContourOptions{});
  const Drawn drawn = Draw(mesh);
  EXPECT_EQ(drawn.num_warnings, 0);
  ASSERT_GE(drawn.strokes.size(), 2u);
  ExpectSameStrokes(drawn.strokes, expected, "the same camera");
}

TEST(DrawMesh, DoesNotDependOnUnitAndPlace) {
  const auto expected = Draw(TorusMesh()).strokes;
  for (const double scale : {1e-200, 1e-6, 1e6, 1e200}) {
    PolygonMesh mesh = TorusMesh();
    mesh.vertices *= scale;
    ExpectSameStrokes(Draw(mesh).strokes, expected, "another unit", 1.0);
  }
  PolygonMesh mesh = TorusMesh();
  mesh.vertices.rowwise() += Eigen::RowVector3d(4e5, -5e6, 1e3);
  ExpectSameStrokes(Draw(mesh).strokes, expected, "another place", 1.0);
  MeshView near = kTiltedView;
  near.distance = 3;
  const auto in_perspective = Draw(TorusMesh(), near).strokes;
  mesh = TorusMesh();
  mesh.vertices *= 1e-6;
  ExpectSameStrokes(Draw(mesh, near).strokes, in_perspective, "another unit in perspective", 1.0);
}

TEST(DrawMesh, DrawsNoLinesAlongSeams) {
  const PolygonMesh mesh = TorusMesh();
  PolygonMesh split{.vertices = mesh.vertices(mesh.corners, Eigen::all), .offsets = mesh.offsets};
  for (int v = 0; v < split.vertices.rows(); ++v) split.corners.push_back(v);
  const Drawn drawn = Draw(split);
  EXPECT_EQ(drawn.num_warnings, 0);
  for (const Stroke& stroke : drawn.strokes) EXPECT_NE(ContourKinds()[size_t(stroke.kind)], "border");
  EXPECT_EQ(drawn.strokes.size(), Draw(mesh).strokes.size());
}

TEST(DrawMesh, IgnoresVerticesThatNoPolygonUses) {
  testing::AllowWarnings();
  PolygonMesh mesh = TorusMesh();
  mesh.vertices.conservativeResize(mesh.vertices.rows() + 2, Eigen::NoChange);
  mesh.vertices.bottomRows(2) << 1e6, 0, 0, kNotANumber, kNotANumber, kNotANumber;
  const Drawn drawn = Draw(mesh);
  EXPECT_EQ(drawn.num_warnings, 1);
  ExpectSameStrokes(drawn.strokes, Draw(TorusMesh()).strokes, "stray vertices");
}

TEST(DrawMesh, LeavesOutDebrisFarAway) {
  testing::AllowWarnings();
  PolygonMesh mesh = TorusMesh();
  AddTriangle(mesh, (geometry::Points(3, 3) << 900, 900, 900, 900.1, 900, 900, 900, 900.1, 900).finished());
  const Drawn drawn = Draw(mesh);
  EXPECT_EQ(drawn.num_warnings, 1);
  ExpectSameStrokes(drawn.strokes, Draw(TorusMesh()).strokes, "debris");
}

TEST(DrawMesh, TurnsWhatIsInsideOutWithAWarning) {
  testing::AllowWarnings();
  PolygonMesh mesh = TorusMesh();
  for (int p = 0; p < mesh.num_polygons(); ++p) std::swap(mesh.corners[3 * p + 1], mesh.corners[3 * p + 2]);
  const Drawn drawn = Draw(mesh);
  EXPECT_EQ(drawn.num_warnings, 1);
  ExpectSameStrokes(drawn.strokes, Draw(TorusMesh()).strokes, "inside out");
}

TEST(DrawMesh, TurnsAnyFrameUpright) {
  using enum AxisDirection;
  const auto expected = Draw(TorusMesh()).strokes;
  for (const AxisDirection up : {kX, kMinusX, kY, kMinusY, kZ, kMinusZ}) {
    PolygonMesh mesh = TorusMesh();
    mesh.vertices *= UprightFromFile(up, FrontFor(up));  // Rows: the inverse rotation.
    MeshView view = kTiltedView;
    view.up = up;
    ExpectSameStrokes(Draw(mesh, view).strokes, expected, "another frame");
  }
}

TEST(DrawMesh, RefusesWhatCannotBeDrawn) {
  PolygonMesh point{.vertices = geometry::Points::Ones(3, 3), .offsets = {0, 3}, .corners = {0, 1, 2}};
  ExpectError([&] { Draw(point); }, "a.obj: no triangle has its corners in three places");
  ExpectError([] { Draw({.vertices = geometry::Points::Ones(3, 3)}); }, "a.obj: has no faces (found 3 vertices");
  point.vertices(1, 0) = kNotANumber;
  ExpectError([&] { Draw(point); }, "a.obj: the position of vertex 1");
  ContourOptions nothing;
  nothing.min_length = 1e4;
  ExpectError([&] { DrawMesh(TorusMesh(), kTiltedView, nothing, "a.obj"); }, "a.obj: no line of its 3600 triangles");
}

// Any corners and places: an Error is the only way out.
TEST(DrawMesh, DrawsOrRefusesDamagedMeshes) {
  testing::AllowWarnings();
  log::SetLevel(log::Level::kOff);
  Rng rng(8);
  int num_drawn = 0;
  for (int i = 0; i < 60; ++i) {
    PolygonMesh mesh = TorusMesh();
    const auto num_damages = rng.Below(1 + 3 * i);
    for (uint64_t damage = 0; damage < num_damages; ++damage) {
      mesh.corners[rng.Below(mesh.corners.size())] = int(rng.Below(uint64_t(mesh.vertices.rows())));
      const double exponent = double(rng.Below(600)) - 300;
      mesh.vertices.data()[rng.Below(uint64_t(mesh.vertices.size()))] *= std::pow(10, i % 3 == 0 ? 0 : exponent);
    }
    try {
      Draw(mesh);
      ++num_drawn;
    } catch (const Error&) {
    }
  }
  EXPECT_GT(num_drawn, 20);
  log::SetLevel(log::Level::kInfo);
}

TEST(UprightFromFile, TakesUpAndFrontToTheirAxes) {
  using enum AxisDirection;
  const Eigen::Matrix3d blender = UprightFromFile(kZ, FrontFor(kZ));
  EXPECT_EQ(blender * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 3, -2)) << "x right, z up, the face looks to -y";
  EXPECT_EQ(UprightFromFile(kMinusY, kMinusZ) * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, -2, -3));
  EXPECT_EQ(UprightFromFile(kY, kZ), Eigen::Matrix3d::Identity());
  for (const AxisDirection up : {kX, kMinusX, kY, kMinusY, kZ, kMinusZ})
    EXPECT_EQ(UprightFromFile(up, FrontFor(up)).determinant(), 1);
  EXPECT_THROW(UprightFromFile(kZ, kMinusZ), UsageError);
}

/// What DrawMesh says of a torus that is stretched along z.
std::string HintsOf(double depth, const MeshView& view) {
  PolygonMesh mesh = TorusMesh();
  mesh.vertices.col(2) *= depth;
  ::testing::internal::CaptureStderr();
  Draw(mesh, view);
  return ::testing::internal::GetCapturedStderr();
}

TEST(DrawMesh, HintsAtUpZOfAMeshThatIsDeeperThanHigh) {
  const std::string hint = "a.obj: it is 1.5 times as long along z as along y. If the drawing shows the top of a head";
  const MeshView view = kTiltedView;
  EXPECT_NE(HintsOf(6, view).find(hint), std::string::npos) << "8 high, 12 deep";
  EXPECT_EQ(HintsOf(4, view).find("--up z"), std::string::npos) << "8 high, 8 deep";
  MeshView with_up = view, with_front = view;
  with_up.up = AxisDirection::kY;
  with_front.front = AxisDirection::kZ;
  EXPECT_EQ(HintsOf(6, with_up).find("--up z"), std::string::npos);
  EXPECT_EQ(HintsOf(6, with_front).find("--up z"), std::string::npos);
}

}  // namespace
}  // namespace daumier::render
