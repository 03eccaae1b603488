#include "render/contours.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"
#include "tests/support/rtsc_reference.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <numbers>

namespace daumier::render {
namespace {

using geometry::TriangleMesh;

struct Viewed {
  Viewed(const TriangleMesh& mesh, const Camera& camera, double threshold = 0)
      : curvatures(geometry::ComputePrincipalCurvatures(mesh)),
        derivatives(geometry::ComputeCurvatureDerivatives(mesh, curvatures)),
        view(ComputeViewCurvature(mesh, curvatures, derivatives, camera, threshold)) {}

  geometry::PrincipalCurvatures curvatures;
  geometry::CurvatureDerivatives derivatives;
  ViewCurvature view;
};

/// Looks along -z.
const Camera kFromFront = FrontalCamera(Eigen::Vector3d::Zero(), 5, 256);

TEST(ViewCurvature, OfASphereIsItsCurvatureTimesSineSquared) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  const Viewed viewed(sphere, kFromFront);
  for (Eigen::Index v = 0; v < sphere.vertices.rows(); ++v) {
    const double cosine = sphere.vertices(v, 2) / 2;
    EXPECT_NEAR(viewed.view.n_dot_v[v], cosine, 0.01);
    EXPECT_NEAR(viewed.view.radial[v], 0.5 * (1 - cosine * cosine), 0.01);
  }
}

/// An ellipsoid with the axes 3, 2, 1.5, seen along v: where n . v = 0 the points lie in the plane sum v_i p_i / a_i^2
/// = 0, and II(w, w) = sum w_i^2 / a_i^2 / sqrt(s), s = sum p_i^2 / a_i^4.
TEST(OccludingContours, OfAnEllipsoidLieInAPlaneAndItsRadialCurvatureIsInClosedForm) {
  const Eigen::Vector3d axes(3, 2, 1.5), squares = axes.cwiseAbs2();
  TriangleMesh ellipsoid = testing::Sphere(1, 6);
  ellipsoid.vertices = ellipsoid.vertices * axes.asDiagonal();
  const Camera camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 25, 35);
  const Eigen::Vector3d towards = -camera.camera_from_world.row(2).transpose();
  const Viewed viewed(ellipsoid, camera);
  for (Eigen::Index v = 0; v < ellipsoid.vertices.rows(); ++v) {
    const Eigen::Vector3d p = ellipsoid.vertices.row(v), gradient = p.cwiseQuotient(squares);
    const Eigen::Vector3d n = gradient.normalized(), w = towards - towards.dot(n) * n;
    const double expected = w.cwiseAbs2().cwiseQuotient(squares).sum() / gradient.norm();
    EXPECT_NEAR(viewed.view.radial[v], expected, 0.1 * (0.1 + expected)) << p.transpose();
  }
  const auto contour = OccludingContours(ellipsoid, viewed.view);
  ASSERT_GT(contour.size(), 100u);
  for (const ContourSegment& segment : contour)
    EXPECT_NEAR(segment.from.point.cwiseQuotient(squares).dot(towards), 0, 0.01) << segment.from.point.transpose();
  EXPECT_TRUE(SuggestiveContours(ellipsoid, viewed.view).empty()) << "it is convex";
}

TEST(OccludingContours, OfASphereAreItsEquatorOrInPerspectiveASmallerCircle) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  const auto ring = OccludingContours(sphere, Viewed(sphere, kFromFront).view);
  ASSERT_GT(ring.size(), 50u);
  for (const ContourSegment& segment : ring) EXPECT_NEAR(segment.from.point.z(), 0, 0.02);
  // From distance 8 the contour of a sphere of radius 2 lies at z = 2 * 2 / 8.
  const auto near_ring = OccludingContours(sphere, Viewed(sphere, WithPerspective(kFromFront, 8)).view);
  ASSERT_GT(near_ring.size(), 50u);
  for (const ContourSegment& segment : near_ring) EXPECT_NEAR(segment.to.point.z(), 0.5, 0.02);
}

TEST(SuggestiveContours, AConvexSurfaceHasNone) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  EXPECT_TRUE(SuggestiveContours(sphere, Viewed(sphere, kFromFront).view).empty());
}

/// A torus (radii 3 and 1, axis z): along the small circle the curvature is 1, along the large one cos b / (3 + cos b)
/// at the angle b of the tube.
TEST(SuggestiveContours, OfATorusLieWhereItsRadialCurvatureIsZeroInClosedForm) {
  const TriangleMesh torus = testing::Torus(3, 1, 240, 120);
  constexpr double kPitch = 40;
  const Camera camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 0, kPitch);
  const double pitch = kPitch * std::numbers::pi / 180;
  const Eigen::Vector3d towards(0, std::sin(pitch), std::cos(pitch));
  const auto segments = SuggestiveContours(torus, Viewed(torus, camera).view);
  ASSERT_GT(segments.size(), 50u);
  for (const ContourSegment& segment : segments) {
    const Eigen::Vector3d p = 0.5 * (segment.from.point + segment.to.point);
    const double around = std::hypot(p.x(), p.y()), cosine = around - 3;
    const Eigen::Vector3d large(-p.y() / around, p.x() / around, 0);
    const Eigen::Vector3d normal(cosine * p.x() / around, cosine * p.y() / around, p.z());
    const double u = towards.dot(normal.cross(large)), v = towards.dot(large);
    EXPECT_NEAR(u * u + v * v * cosine / around, 0, 0.01) << p.transpose();
    EXPECT_LT(cosine, 0.01) << "the inner side alone is saddle-shaped";
    EXPECT_GT(towards.dot(normal), -0.05) << "it faces the viewer";
  }
}

TEST(SuggestiveContours, AThresholdLeavesFewer) {
  const TriangleMesh torus = testing::Torus(3, 1, 120, 60);
  const Camera camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 0, 70);
  const auto count = [&](double threshold) {
    return SuggestiveContours(torus, Viewed(torus, camera, threshold).view).size();
  };
  EXPECT_GT(count(0), count(0.3));
}

TEST(SuggestiveContours, StopWhereTheSurfaceFacesTheViewerMoreThanAllowed) {
  const TriangleMesh torus = testing::Torus(3, 1, 120, 60);
  const Viewed viewed(torus, TurnedCamera(Eigen::Vector3d::Zero(), 5, 256, 0, 40));
  const auto cosines = [&](double limit) {
    std::vector<double> values;
    for (const ContourSegment& segment : SuggestiveContours(torus, viewed.view, limit)) {
      for (const ContourEnd& end : {segment.from, segment.to}) {
        if (end.edge[0] < 0) continue;
        const Eigen::Vector3d a = torus.vertices.row(end.edge[0]), b = torus.vertices.row(end.edge[1]);
        const double share = (end.point - a).norm() / (b - a).norm();
        values.push_back((1 - share) * viewed.view.n_dot_v[end.edge[0]] + share * viewed.view.n_dot_v[end.edge[1]]);
      }
    }
    return values;
  };
  const auto all = cosines(1);
  const double limit = 0.5 * (*std::min_element(all.begin(), all.end()) + *std::max_element(all.begin(), all.end()));
  const auto kept = cosines(limit);
  ASSERT_FALSE(kept.empty());
  EXPECT_LT(kept.size(), all.size());
  EXPECT_LE(*std::max_element(kept.begin(), kept.end()), limit + 1e-9);
}

TEST(Borders, AreTheEdgesOfOneTriangle) {
  const auto segments = Borders(testing::FlatSheet(4));
  EXPECT_EQ(segments.size(), 16u);
  for (const ContourSegment& segment : segments) {
    for (const ContourEnd& end : {segment.from, segment.to}) {
      const bool on_border = end.point.x() == 0 || end.point.x() == 1 || end.point.y() == 0 || end.point.y() == 1;
      EXPECT_TRUE(on_border);
    }
  }
  EXPECT_TRUE(Borders(testing::Sphere(1, 2)).empty());
}

TEST(FeatureSize, ScalesWithTheMesh) {
  TriangleMesh torus = testing::Torus(3, 1, 60, 30);
  const double size = FeatureSize(torus, geometry::ComputePrincipalCurvatures(torus));
  torus.vertices *= 4;
  EXPECT_NEAR(FeatureSize(torus, geometry::ComputePrincipalCurvatures(torus)), 4 * size, 1e-9);
  TriangleMesh none{geometry::Points(0, 3), geometry::Triangles(0, 3)};
  testing::ExpectError([&] { FeatureSize(none, geometry::ComputePrincipalCurvatures(none)); }, "without vertices");
}

TEST(ViewCurvature, RefusesCurvaturesOfAnotherMesh) {
  const TriangleMesh sphere = testing::Sphere(1, 1);
  const Viewed other(testing::Sphere(1, 2), kFromFront);
  testing::ExpectError([&] { ComputeViewCurvature(sphere, other.curvatures, other.derivatives, kFromFront, 0); },
                       "for a mesh of 18");
}

/// Of the segments of `ours`, the share whose ends are those of one of `theirs`.
double ShareFound(const std::vector<std::array<Eigen::Vector3d, 2>>& ours,
                  const std::vector<std::array<Eigen::Vector3d, 2>>& theirs, double tolerance) {
  int num_found = 0;
  for (const auto& [a, b] : ours) {
    num_found += std::any_of(theirs.begin(), theirs.end(), [&, a = a, b = b](const auto& other) {
      const auto near = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) { return (p - q).norm() < tolerance; };
      return (near(a, other[0]) && near(b, other[1])) || (near(a, other[1]) && near(b, other[0]));
    });
  }
  return double(num_found) / double(ours.size());
}

class ReferenceContours : public ::testing::TestWithParam<const char*> {};

TEST_P(ReferenceContours, AgreeWithTheProgramOnceItsFaultIsInjected) {
  const auto reference = testing::RtscReference::Load(GetParam());
  if (!reference) GTEST_SKIP() << "no golden files next to the checkout";
  const TriangleMesh& mesh = reference->mesh;
  Camera camera;  // Looks along -z from the reference's eye.
  camera.perspective = true;
  camera.translation = -(camera.camera_from_world * reference->eye);
  const auto curvatures = geometry::ComputePrincipalCurvatures(mesh, testing::SolveWithStalePivot);
  EXPECT_NEAR(FeatureSize(mesh, curvatures), reference->feature_size, 1e-3 * reference->feature_size);
  const double threshold = 0.01 / (reference->feature_size * reference->feature_size);
  const ViewCurvature view = ComputeViewCurvature(
      mesh, curvatures, geometry::ComputeCurvatureDerivatives(mesh, curvatures), camera, threshold);
  const auto& rows = reference->rows;
  EXPECT_GE(testing::ShareThatAgrees(view.n_dot_v, rows.col(19)), 0.999);
  EXPECT_GE(testing::ShareThatAgrees(view.radial, rows.col(20)), 0.99);
  EXPECT_GE(testing::ShareThatAgrees(view.rise, rows.col(21)), 0.99);

  const auto ends = [](const std::vector<ContourSegment>& segments) {
    std::vector<std::array<Eigen::Vector3d, 2>> result;
    for (const ContourSegment& segment : segments) result.push_back({segment.from.point, segment.to.point});
    return result;
  };
  const auto suggestive = ends(SuggestiveContours(mesh, view)), occluding = ends(OccludingContours(mesh, view));
  const double tolerance = 1e-3;  // Of a head 2.3 units high.
  EXPECT_GE(ShareFound(suggestive, reference->suggestive, tolerance), 0.97);
  EXPECT_GE(ShareFound(reference->suggestive, suggestive, tolerance), 0.97);
  EXPECT_GE(ShareFound(occluding, reference->occluding, tolerance), 0.97);
  EXPECT_GE(ShareFound(reference->occluding, occluding, tolerance), 0.97);
}

INSTANTIATE_TEST_SUITE_P(Views, ReferenceContours, ::testing::Values("default", "ortho"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace daumier::render
