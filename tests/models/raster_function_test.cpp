#include "models/raster_function.h"

#include "tests/support/expect_error.h"
#include "tests/support/gradcheck.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace daumier::models {
namespace {

using testing::ExpectError;

/// Two tetrahedra, one in front of the other, that fill a picture of 12 x 10 pixels.
SharedTopology Tetrahedra() {
  const std::vector<int> corners = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2, 4, 5, 6, 4, 6, 7, 4, 7, 5, 5, 7, 6};
  return std::make_shared<raster::MeshTopology>(raster::MakeTopology(corners, 8));
}

const raster::Camera kSmallCamera = {
    .focal = 90, .centre_x = 6, .centre_y = 5, .distance = 20, .height = 10, .width = 12};

torch::Tensor TetrahedraVertices() {
  return torch::tensor({{{0.05, 0.13, 1.0},
                         {-0.9, -0.61, 0.1},
                         {0.83, -0.5, 0.0},
                         {0.11, 0.77, -0.2},
                         {0.35, 0.32, -1.0},
                         {-0.62, -0.22, -2.1},
                         {1.1, -0.03, -2.2},
                         {0.4, 0.91, -2.0}}},
                       torch::kFloat64);
}

torch::Tensor TetrahedraAlbedo() {
  torch::manual_seed(3);
  return torch::rand({1, 8, 3}, torch::kFloat64);
}

const torch::Tensor kSmallLight =
    torch::tensor({{0.1, -0.2, 0.3, 0.15, 0.05, -0.1, 0.08, 0.04, 0.06}}, torch::kFloat64);
const torch::Tensor kSmallPose = torch::tensor({{0.1, -0.2, 0.05, 0.03, -0.02, 0.4}}, torch::kFloat64);

/// A functional of both results.
torch::Tensor WeightedSum(const RenderedPictures& rendered) {
  torch::manual_seed(5);
  const torch::Tensor weights = torch::rand(rendered.pictures.sizes(), torch::kFloat64) - 0.3;
  return (rendered.pictures * weights).sum() + (rendered.masks * weights.narrow(1, 0, 1)).sum();
}

TEST(RenderFace, GradientByAlbedoAndLightEqualsCentralDifferences) {
  const auto topology = Tetrahedra();
  const torch::Tensor vertices = TetrahedraVertices(), albedo = TetrahedraAlbedo();
  EXPECT_LT(testing::MaxGradientError(
                [&](const torch::Tensor& x) {
                  return WeightedSum(RenderFace(topology, vertices, x, kSmallLight, kSmallPose, kSmallCamera));
                },
                albedo),
            1e-8);
  EXPECT_LT(testing::MaxGradientError(
                [&](const torch::Tensor& x) {
                  return WeightedSum(RenderFace(topology, vertices, albedo, x, kSmallPose, kSmallCamera));
                },
                kSmallLight),
            1e-8);
}

TEST(RenderFace, GradientByTranslationEqualsCentralDifferences) {
  // In an orthographic view a translation keeps the slopes of edges, which have no gradient.
  const auto topology = Tetrahedra();
  const torch::Tensor albedo = TetrahedraAlbedo();
  raster::Camera camera = kSmallCamera;
  camera.projection = raster::Camera::Projection::kOrthographic;
  camera.focal = 4.5;
  EXPECT_LT(testing::MaxGradientError(
                [&](const torch::Tensor& x) {
                  const torch::Tensor pose = torch::cat({kSmallPose.narrow(1, 0, 3), x, kSmallPose.narrow(1, 5, 1)}, 1);
                  return WeightedSum(RenderFace(topology, TetrahedraVertices(), albedo, kSmallLight, pose, camera));
                },
                kSmallPose.narrow(1, 3, 2)),
            1e-7);
}

TEST(RenderFace, EveryInputHasAGradient) {
  const auto topology = Tetrahedra();
  std::vector<torch::Tensor> inputs = {TetrahedraVertices(), TetrahedraAlbedo(), kSmallLight.clone(),
                                       kSmallPose.clone()};
  for (auto& input : inputs) input.set_requires_grad(true);
  WeightedSum(RenderFace(topology, inputs[0], inputs[1], inputs[2], inputs[3], kSmallCamera)).backward();
  for (const auto& input : inputs) {
    EXPECT_GT(input.grad().abs().sum().item<double>(), 1e-2);
    EXPECT_TRUE(torch::isfinite(input.grad()).all().item<bool>());
  }
}

TEST(RenderFace, IsRenderColoursOfShadedColours) {
  const auto topology = Tetrahedra();
  const torch::Tensor vertices = TetrahedraVertices(), white = torch::ones({1, 8, 3}, torch::kFloat64);
  const torch::Tensor ambient = torch::zeros({1, 9}, torch::kFloat64);
  const RenderedPictures face = RenderFace(topology, vertices, white, ambient, kSmallPose, kSmallCamera);
  const torch::Tensor positions = ProjectedPoints(PosedPoints(vertices, kSmallPose), kSmallCamera);
  const RenderedPictures flat = RenderColours(topology, positions, white * (0.8 * 0.886227), 10, 12);
  EXPECT_TRUE(torch::allclose(face.pictures, flat.pictures, 1e-9, 1e-9));
  EXPECT_TRUE(torch::allclose(face.masks, flat.masks, 1e-9, 1e-9));
  EXPECT_GT(face.masks.sum().item<double>(), 30);
}

TEST(RenderFace, OfABatchIsThatOfEachFaceInFloat32) {
  const auto topology = Tetrahedra();
  const torch::Tensor vertices = TetrahedraVertices().to(torch::kFloat32),
                      albedo = TetrahedraAlbedo().to(torch::kFloat32);
  const torch::Tensor light = kSmallLight.to(torch::kFloat32), pose = kSmallPose.to(torch::kFloat32);
  const RenderedPictures one = RenderFace(topology, vertices, albedo, light, pose, kSmallCamera);
  const RenderedPictures two = RenderFace(topology, vertices.repeat({5, 1, 1}), albedo.repeat({5, 1, 1}),
                                          light.repeat({5, 1}), pose.repeat({5, 1}), kSmallCamera);
  ASSERT_EQ(two.pictures.sizes(), (std::vector<int64_t>{5, 3, 10, 12}));
  ASSERT_EQ(two.masks.sizes(), (std::vector<int64_t>{5, 1, 10, 12}));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(torch::equal(two.pictures[i], one.pictures[0]));
}

TEST(PointsInPicture, AreThoseOfTheCameraWorkedOutByHand) {
  const torch::Tensor point = torch::tensor({{{1.0, 2.0, 0.0}}}, torch::kFloat64);
  const torch::Tensor pose = torch::tensor({{0.0, 0.0, 0.0, 0.0, 0.0, 50.0}}, torch::kFloat64);
  const torch::Tensor at = PointsInPicture(point, pose);  // z_view = 100 - 50
  EXPECT_NEAR(at[0][0][0].item<double>(), 112 + 1015.0 / 50, 1e-9);
  EXPECT_NEAR(at[0][0][1].item<double>(), 112 - 2 * 1015.0 / 50, 1e-9);
}

TEST(RenderFace, RefusesWrongShapesAndNumbersThatAreNotFinite) {
  const auto topology = Tetrahedra();
  const torch::Tensor vertices = TetrahedraVertices(), albedo = TetrahedraAlbedo();
  ExpectError([&] { RenderFace(topology, vertices, albedo.narrow(1, 0, 7), kSmallLight, kSmallPose); }, "albedo");
  ExpectError([&] { RenderFace(topology, vertices, albedo.to(torch::kFloat32), kSmallLight, kSmallPose); }, "float");
  torch::Tensor broken = vertices.clone();
  broken[0][2][1] = std::numeric_limits<double>::quiet_NaN();
  ExpectError([&] { RenderFace(topology, broken, albedo, kSmallLight, kSmallPose); }, "not finite");
}

}  // namespace
}  // namespace daumier::models
