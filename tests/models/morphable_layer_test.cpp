#include "models/morphable_layer.h"

#include <torch/utils.h>
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::models {
namespace {

/// Four vertices (n, 10 n, 100 n); landmark l is vertex l modulo 4. Two identity modes, one expression, one of colours.
faces::MorphableModel FourVertices() {
  faces::MorphableModel model;
  geometry::Points& neutral = model.face_template.neutral;
  neutral.resize(4, 3);
  for (int n = 0; n < 4; ++n) neutral.row(n) << n, 10 * n, 100 * n;
  model.face_template.triangles.resize(2, 3);
  model.face_template.triangles << 0, 1, 2, 2, 1, 3;
  for (size_t l = 0; l < 68; ++l) model.face_template.annotation.landmarks[l] = int(l % 4);
  model.identity = Eigen::MatrixXf::Zero(12, 2);
  model.identity(3, 0) = 2;   // x of vertex 1.
  model.identity(11, 1) = 5;  // z of vertex 3.
  model.expression = Eigen::MatrixXf::Constant(12, 1, 0.5F);
  model.albedo_mean = Eigen::MatrixXf::Constant(4, 3, 0.25F);
  model.albedo_modes = Eigen::MatrixXf::Zero(12, 1);
  model.albedo_modes(7, 0) = 0.1F;  // Green of vertex 2.
  return model;
}

torch::Tensor SomeCoefficients() {
  torch::Tensor x = torch::zeros({2, faces::kNumCoefficients});
  x[1][faces::kIdentitySlot.first] = 3;
  x[1][faces::kIdentitySlot.first + 1] = -1;
  x[1][faces::kExpressionSlot.first] = 0.5;
  x[1][faces::kAlbedoSlot.first] = 2;
  return x;
}

TEST(MorphableLayer, AddsModesToTheMean) {
  const MorphableLayer layer(FourVertices());
  const torch::Tensor x = SomeCoefficients(), vertices = layer.Vertices(x), albedo = layer.Albedo(x);
  ASSERT_EQ(vertices.sizes(), (std::vector<int64_t>{2, 4, 3}));
  EXPECT_EQ(layer.num_vertices(), 4);
  EXPECT_FLOAT_EQ(vertices[0][3][1].item<float>(), 30);
  EXPECT_FLOAT_EQ(vertices[1][1][0].item<float>(), 1 + 3 * 2 + 0.25F);
  EXPECT_FLOAT_EQ(vertices[1][3][2].item<float>(), 300 - 5 + 0.25F);
  EXPECT_FLOAT_EQ(vertices[1][0][1].item<float>(), 0.25F);
  EXPECT_FLOAT_EQ(albedo[1][2][1].item<float>(), 0.45F);
  EXPECT_FLOAT_EQ(albedo[1][2][0].item<float>(), 0.25F);
  EXPECT_EQ(layer.triangles().scalar_type(), torch::kInt32);
  EXPECT_EQ(layer.triangles()[1][2].item<int>(), 3);
}

TEST(MorphableLayer, LandmarksAreRowsOfTheVertices) {
  const MorphableLayer layer(FourVertices());
  const torch::Tensor x = SomeCoefficients(), landmarks = layer.Landmarks(x);
  ASSERT_EQ(landmarks.sizes(), (std::vector<int64_t>{2, 68, 3}));
  EXPECT_TRUE(landmarks.slice(1, 4, 8).allclose(layer.Vertices(x)));
  EXPECT_TRUE(landmarks.select(1, 67).allclose(layer.Vertices(x).select(1, 3)));
}

TEST(MorphableLayer, AgreesWithReconstruct) {
  torch::manual_seed(3);
  const faces::MorphableModel model = FourVertices();
  const torch::Tensor x = torch::randn({1, faces::kNumCoefficients}), of_layer = MorphableLayer(model).Vertices(x);
  const faces::ColouredFace face = faces::Reconstruct(model, {x.data_ptr<float>(), size_t(faces::kNumCoefficients)});
  for (int n = 0; n < 4; ++n)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(of_layer[0][n][k].item<double>(), face.vertices(n, k), 1e-4);
}

TEST(MorphableLayer, NumbersWithoutAModeHaveNoEffect) {
  const MorphableLayer layer(FourVertices());
  torch::Tensor x = SomeCoefficients();
  const torch::Tensor vertices = layer.Vertices(x), albedo = layer.Albedo(x);
  for (const int unused : {2, 79, 81, 145, 224, 238}) x.select(1, unused).fill_(9);
  EXPECT_TRUE(layer.Vertices(x).equal(vertices));
  EXPECT_TRUE(layer.Albedo(x).equal(albedo));
}

TEST(MorphableLayer, GradientsAreTheModes) {
  const MorphableLayer layer(FourVertices(), torch::kFloat64);
  const torch::Tensor x = SomeCoefficients().to(torch::kFloat64).set_requires_grad(true);
  layer.Vertices(x).select(1, 1).sum().backward();  // Of vertex 1 alone.
  EXPECT_DOUBLE_EQ(x.grad()[0][0].item<double>(), 2);
  EXPECT_DOUBLE_EQ(x.grad()[0][1].item<double>(), 0);
  EXPECT_DOUBLE_EQ(x.grad()[1][faces::kExpressionSlot.first].item<double>(), 1.5);
}

TEST(MorphableLayer, RefusesAnotherNumberOfCoefficients) {
  const MorphableLayer layer(FourVertices());
  const torch::Tensor x = torch::zeros({1, 228});
  testing::ExpectError([&] { layer.Vertices(x); }, "coefficients has shape");
  testing::ExpectError([&] { layer.Landmarks(x); }, "coefficients has shape");
  testing::ExpectError([&] { layer.Albedo(x); }, "coefficients has shape");
}

}  // namespace
}  // namespace daumier::models
