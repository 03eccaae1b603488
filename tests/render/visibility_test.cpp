#include "render/visibility.h"

#include "core/error.h"
#include "core/random.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <optional>

namespace daumier::render {
namespace {

using geometry::TriangleMesh;

const Camera kFrontCamera = FrontalCamera(Eigen::Vector3d::Zero(), 5, 256);

Eigen::RowVector3d Projected(const Camera& camera, const Eigen::Vector3d& point) {
  return Project(camera, geometry::Points(point.transpose())).row(0);
}

TEST(Visibility, ASphereHidesItsBackAndWhatLiesBehindIt) {
  const Visibility visibility(kFrontCamera, testing::Sphere(2, 4), 0.05);
  const auto sees = [&](double x, double y, double z) { return visibility.Sees(Projected(kFrontCamera, {x, y, z})); };
  EXPECT_TRUE(sees(0, 0, 2));
  EXPECT_FALSE(sees(0, 0, -2));
  EXPECT_FALSE(sees(1, 0.5, -3));
  EXPECT_TRUE(sees(1, 0.5, 3));
  EXPECT_TRUE(sees(2.5, 0, -3)) << "next to it";
  EXPECT_TRUE(sees(2, 0, 0)) << "the contour itself";
  EXPECT_TRUE(sees(900, 0, 0)) << "outside of the picture";
}

TEST(Visibility, ADepthMapAtHandHidesWhatItsSurfaceHides) {
  const TriangleMesh sphere = testing::Sphere(2, 4);
  const Visibility from_mesh(kFrontCamera, sphere, 0.05);
  Raster depth{.height = kFrontCamera.height, .width = kFrontCamera.width};
  depth.depth = Rasterise(kFrontCamera, sphere).depth;
  const Visibility from_depth(kFrontCamera, depth, 0.05);
  for (double x = -3; x <= 3; x += 0.25) {
    for (double z = -3; z <= 3; z += 0.5) {
      const Eigen::RowVector3d point = Projected(kFrontCamera, {x, 0.1, z});
      EXPECT_EQ(from_depth.Sees(point), from_mesh.Sees(point)) << x << " " << z;
    }
  }
  depth.depth.pop_back();
  EXPECT_THROW(Visibility(kFrontCamera, depth, 0.05), Error);
}

TEST(Visibility, TheToleranceIsADepthInCm) {
  const TriangleMesh sheet = testing::Sheet(4, [](double, double) { return 1.0; });
  const Visibility visibility(kFrontCamera, sheet, 0.2);
  EXPECT_TRUE(visibility.Sees(Projected(kFrontCamera, {0.5, 0.5, 0.81})));
  EXPECT_FALSE(visibility.Sees(Projected(kFrontCamera, {0.5, 0.5, 0.79})));
  testing::ExpectError([&] { Visibility(kFrontCamera, sheet, -1); }, "tolerance -1");
}

/// Whether a ray towards the viewer meets the surface, farther away than the tolerance.
bool IsHiddenByRay(const TriangleMesh& mesh, const Camera& camera, const Eigen::Vector3d& point, double tolerance) {
  const Eigen::Vector3d towards = -camera.camera_from_world.row(2).transpose();
  for (int f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::Vector3d a = mesh.vertices.row(mesh.triangles(f, 0)), b = mesh.vertices.row(mesh.triangles(f, 1)),
                          c = mesh.vertices.row(mesh.triangles(f, 2));
    Eigen::Matrix3d system;
    system << b - a, c - a, -towards;
    if (std::abs(system.determinant()) < 1e-12) continue;
    const Eigen::Vector3d x = system.inverse() * (point - a);
    if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] > tolerance) return true;
  }
  return false;
}

TEST(Visibility, AgreesWithRaysOnATorus) {
  const TriangleMesh torus = testing::Torus(3, 1, 48, 24);
  const Camera camera = TurnedCamera(Eigen::Vector3d::Zero(), 5, 1024, 30, 60);
  constexpr double kTolerance = 0.05;
  const Visibility visibility(camera, torus, kTolerance);
  Rng rng(3);
  int num_agree = 0, num_hidden = 0;
  constexpr int kPoints = 400;
  for (int i = 0; i < kPoints; ++i) {
    const auto f = Eigen::Index(rng.Below(uint64_t(torus.triangles.rows())));
    const Eigen::Vector3d point =
        (torus.vertices.row(torus.triangles(f, 0)) + torus.vertices.row(torus.triangles(f, 1)) +
         torus.vertices.row(torus.triangles(f, 2))) /
        3;
    const bool is_hidden = IsHiddenByRay(torus, camera, point, kTolerance);
    num_hidden += is_hidden;
    num_agree += visibility.Sees(Projected(camera, point)) != is_hidden;
  }
  EXPECT_GT(num_hidden, kPoints / 4);
  EXPECT_LT(num_hidden, 3 * kPoints / 4);
  EXPECT_GE(num_agree, 0.95 * kPoints) << "they differ within a pixel and a half of an occluder's border alone";
}

}  // namespace
}  // namespace daumier::render
