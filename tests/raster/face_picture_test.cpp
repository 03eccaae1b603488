#include "raster/face_picture.h"

#include "tests/raster/small_mesh.h"

#include <gtest/gtest.h>

namespace daumier::raster {
namespace {

using Light = std::array<double, kLightBands>;

/// A bumpy ball in cm, in an orthographic picture of 20 x 22 pixels.
struct FacePictureTest : ::testing::Test {
  Camera camera = {.projection = Camera::Projection::kOrthographic,
                   .focal = 15,
                   .centre_x = 11,
                   .centre_y = 10,
                   .height = 20,
                   .width = 22};
  PositionedMesh<double> mesh = BumpyBall<double>(
      6, 0.6, {.projection = Camera::Projection::kOrthographic, .focal = 1, .centre_x = 0, .centre_y = 0});
  int num_vertices = mesh.topology.num_vertices;
  std::vector<double> vertices, albedo = RandomNumbers<double>(3 * num_vertices, 1),
                                weights = RandomNumbers<double>(4 * 20 * 22, 2);
  Light light = {0.1, -0.2, 0.3, 0.15, 0.05, -0.1, 0.08, 0.04, 0.06};
  Pose<double> pose = {0.1, -0.2, 0.05, 0.03, -0.02, 0.4};

  void SetUp() override {
    for (int v = 0; v < num_vertices; ++v) {  // Positions are (x, -y, -z, 1).
      vertices.insert(vertices.end(), {mesh.positions[4 * v], -mesh.positions[4 * v + 1], -mesh.positions[4 * v + 2]});
    }
  }

  double Sum(const Light& of_light, const Pose<double>& of_pose, const std::vector<double>& of_albedo,
             const std::vector<double>& of_vertices) {
    FacePicture<double> face;
    std::vector<double> image(weights.size());
    face.Forward(mesh.topology, of_vertices.data(), of_albedo.data(), of_light, of_pose, camera, {}, image.data());
    return Dot(weights, image);
  }
};

TEST_F(FacePictureTest, GradientsEqualCentralDifferences) {
  FacePicture<double> face;
  std::vector<double> image(weights.size()), by_vertices(vertices.size()), by_albedo(albedo.size());
  Light by_light;
  Pose<double> by_pose;
  face.Forward(mesh.topology, vertices.data(), albedo.data(), light, pose, camera, {}, image.data());
  face.Backward(mesh.topology, vertices.data(), albedo.data(), weights.data(), by_vertices.data(), by_albedo.data(),
                by_light, by_pose);
  EXPECT_LT(MaxDifference([&](const auto& x) { return Sum(light, pose, x, vertices); }, albedo, by_albedo), 1e-7);
  const auto of_light = [&](const std::vector<double>& x) {
    Light given;
    std::copy_n(x.begin(), kLightBands, given.begin());
    return Sum(given, pose, albedo, vertices);
  };
  EXPECT_LT(MaxDifference(of_light, {light.begin(), light.end()}, {by_light.begin(), by_light.end()}), 1e-7);
  const auto of_pose = [&](const std::vector<double>& x) {
    Pose<double> given;
    std::copy_n(x.begin(), 6, given.begin());
    return Sum(light, given, albedo, vertices);
  };
  // Translations keep the slopes of silhouette edges, which have no gradient.
  EXPECT_LT(MaxDifference(of_pose, {pose.begin(), pose.end()}, {by_pose.begin(), by_pose.end()}, 1e-6,
                          [](size_t i) { return i >= 3; }),
            1e-6);
  // Scaling about the origin keeps them as well, and the normals.
  double along_scale = 0;
  std::vector<double> larger = vertices, smaller = vertices;
  for (size_t i = 0; i < vertices.size(); ++i) {
    along_scale += by_vertices[i] * vertices[i];
    larger[i] *= 1 + 1e-7, smaller[i] *= 1 - 1e-7;
  }
  EXPECT_NEAR(along_scale, (Sum(light, pose, albedo, larger) - Sum(light, pose, albedo, smaller)) / 2e-7, 1e-5);
}

TEST_F(FacePictureTest, GradientByVerticesInsideEqualsCentralDifferences) {
  // With weights inside of the silhouette alone every vertex has its gradient: by normals and by places.
  FacePicture<double> face;
  std::vector<double> image(weights.size()), by_vertices(vertices.size()), by_albedo(albedo.size());
  face.Forward(mesh.topology, vertices.data(), albedo.data(), light, pose, camera, {}, image.data());
  for (size_t i = 0; i < weights.size(); ++i) weights[i] *= image[i / 4 * 4 + 3] == 1 ? 1 : 0;
  for (const auto& crossing : face.picture().crossings()) {
    for (int k = 0; k < 4; ++k) weights[4 * crossing.pixel + k] = weights[4 * crossing.next + k] = 0;
  }
  Light by_light;
  Pose<double> by_pose;
  face.Backward(mesh.topology, vertices.data(), albedo.data(), weights.data(), by_vertices.data(), by_albedo.data(),
                by_light, by_pose);
  EXPECT_LT(MaxDifference([&](const auto& x) { return Sum(light, pose, albedo, x); }, vertices, by_vertices), 1e-5);
  const auto of_pose = [&](const std::vector<double>& x) {
    Pose<double> given;
    std::copy_n(x.begin(), 6, given.begin());
    return Sum(light, given, albedo, vertices);
  };
  EXPECT_LT(MaxDifference(of_pose, {pose.begin(), pose.end()}, {by_pose.begin(), by_pose.end()}), 1e-5);
}

TEST_F(FacePictureTest, OfWhiteUnderNoLightIsTheAmbientShade) {
  FacePicture<double> face;
  std::vector<double> image(weights.size());
  face.Forward(mesh.topology, vertices.data(), std::vector<double>(albedo.size(), 1.0).data(), {}, pose, camera, {},
               image.data());
  int num_inside = 0;
  for (size_t i = 0; i < image.size(); i += 4) {
    EXPECT_NEAR(image[i], 0.8 * 0.886227 * image[i + 3], 1e-12);
    num_inside += image[i + 3] == 1 ? 1 : 0;
  }
  EXPECT_GT(num_inside, 150);
}

}  // namespace
}  // namespace daumier::raster
