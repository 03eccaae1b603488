#include "datasets/read/point_dataset.h"

#include "datasets/build/points.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <torch/types.h>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

class PointDatasetTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 2);
    PointsOptions options;
    options.faces = (*folder_ / "faces").string();
    options.num_samples = 600;
    options.mouth_gap = 0.2;
    BuildPoints(options, *folder_ / "points");
    faces_ = new faces::FaceDatabase(*folder_ / "faces");
    points_ = new PointDatabase(*folder_ / "points");
  }
  static void TearDownTestSuite() {
    delete points_;
    delete faces_;
    delete folder_;
  }
  static PointDataset Dataset(const PointReading& reading, std::vector<int> which = {3, 11, 5}, uint64_t seed = 9) {
    return PointDataset(*faces_, *points_, std::move(which), reading, seed);
  }
  static torch::Tensor Model(const geometry::Points& points_cm) {
    const geometry::Points model = points_->frame().FromCm(points_cm);
    return torch::from_blob(const_cast<double*>(model.data()), {model.rows(), 3}, torch::kFloat64).to(torch::kFloat32);
  }
  static torch::Tensor Template() {
    return torch::tensor(std::vector<float>(points_->template_vertices().begin(), points_->template_vertices().end()))
        .view({-1, 3});
  }
  /// What the batch says of face `row` against tensor operations on its corners.
  static void ExpectPointsOf(const PointBatch& batch, int64_t row, int face) {
    const auto mixed = [&](const torch::Tensor& vertices) {
      const torch::Tensor corners = vertices.index_select(0, batch.corners[row].flatten()).view({-1, 3, 3});
      return (corners * batch.weights[row].unsqueeze(2)).sum(1);
    };
    EXPECT_TRUE(torch::allclose(batch.positions[row], mixed(Template()), 0, 1e-6));
    EXPECT_TRUE(torch::allclose(batch.targets[row], mixed(Model(faces_->points(face))), 0, 1e-5));
  }
  static bool Equal(const PointBatch& a, const PointBatch& b) {
    return torch::equal(a.corners, b.corners) && torch::equal(a.weights, b.weights) &&
           torch::equal(a.positions, b.positions) && torch::equal(a.targets, b.targets);
  }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* faces_ = nullptr;
  static inline PointDatabase* points_ = nullptr;
};

TEST_F(PointDatasetTest, PointsLieInTheirTrianglesOnTemplateAndFace) {
  const PointBatch batch = Dataset({.num_points = 200}).Get(std::vector<int>{2, 0}, 3);
  const std::vector<int64_t> shape{2, 200, 3};
  for (const torch::Tensor& tensor : {batch.corners, batch.weights, batch.positions, batch.targets})
    ASSERT_EQ(tensor.sizes().vec(), shape);
  EXPECT_EQ(batch.corners.scalar_type(), torch::kInt64);
  for (const torch::Tensor& tensor : {batch.weights, batch.positions, batch.targets})
    EXPECT_EQ(tensor.scalar_type(), torch::kFloat32);
  EXPECT_GE(batch.weights.min().item<float>(), 0);
  EXPECT_TRUE(torch::allclose(batch.weights.sum(2), torch::ones({2, 200}), 0, 1e-6));
  ExpectPointsOf(batch, 0, 5);
  ExpectPointsOf(batch, 1, 3);
}

TEST_F(PointDatasetTest, AllPointsAreTheVerticesAndThenTheSamples) {
  const PointBatch batch = Dataset({.num_points = 0}).Get(std::vector<int>{1});
  const int64_t num_vertices = points_->num_vertices();
  ASSERT_EQ(batch.corners.size(1), num_vertices + 600);
  ExpectPointsOf(batch, 0, 11);
  const SurfaceSamples samples = points_->samples(11);
  for (const int s : {0, 77, 599}) {
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(batch.corners[0][num_vertices + s][k].item<int64_t>(),
                points_->face_template().triangles(samples.triangles[size_t(s)], k));
    EXPECT_EQ(batch.weights[0][num_vertices + s][1].item<float>(), samples.weights[size_t(2 * s + 1)]);
  }
  EXPECT_EQ(Dataset({.num_points = 0, .sampling = "vertices"}).Get(std::vector<int>{1}).corners.size(1), num_vertices);
}

TEST_F(PointDatasetTest, VerticesAreAllVerticesInOrder) {
  const PointBatch batch = Dataset({.num_points = 50}).Vertices(std::vector<int>{1, 2});
  const int64_t num_vertices = points_->num_vertices();
  const torch::Tensor order = torch::arange(num_vertices).unsqueeze(1).expand({num_vertices, 3});
  const torch::Tensor first = torch::tensor({1.0f, 0.0f, 0.0f}).expand({num_vertices, 3});
  for (const auto& [row, face] : {std::pair{0, 11}, {1, 5}}) {
    EXPECT_TRUE(torch::equal(batch.corners[row], order));
    EXPECT_TRUE(torch::equal(batch.weights[row], first));
    EXPECT_TRUE(torch::equal(batch.positions[row], Template()));
    EXPECT_TRUE(torch::allclose(batch.targets[row], Model(faces_->points(face)), 0, 1e-5));
  }
}

TEST_F(PointDatasetTest, ABatchIsAFunctionOfSeedFaceAndEpoch) {
  const PointReading reading{.num_points = 300};
  const PointDataset dataset = Dataset(reading);
  const PointBatch alone = dataset.Get(std::vector<int>{1}, 4);
  EXPECT_TRUE(Equal(Dataset(reading, {0, 11}).Get(std::vector<int>{1}, 4), alone));
  EXPECT_TRUE(torch::equal(dataset.Get(std::vector<int>{0, 1, 2}, 4).targets[1], alone.targets[0]));
  EXPECT_FALSE(torch::equal(dataset.Get(std::vector<int>{1}, 5).corners, alone.corners));
  EXPECT_FALSE(torch::equal(Dataset(reading, {11}, 8).Get(std::vector<int>{0}, 4).corners, alone.corners));
  EXPECT_FALSE(torch::equal(dataset.Get(std::vector<int>{0}, 4).corners, alone.corners));
}

TEST_F(PointDatasetTest, HybridsTakeVerticesAndSamplesInTheirProportion) {
  const auto share_of_vertices = [](const PointBatch& batch) {
    return batch.corners.select(2, 0).eq(batch.corners.select(2, 1)).to(torch::kFloat32).mean().item<double>();
  };
  const std::vector<int> samples{0, 1, 2};
  const double expected = double(points_->num_vertices()) / (points_->num_vertices() + 600);
  EXPECT_NEAR(share_of_vertices(Dataset({.num_points = 4000}).Get(samples)), expected, 0.02);
  const PointBatch vertices = Dataset({.num_points = 4000, .sampling = "vertices"}).Get(samples);
  EXPECT_EQ(share_of_vertices(vertices), 1);
  EXPECT_LT(vertices.corners.min().item<int64_t>(), 20);
  EXPECT_GT(vertices.corners.max().item<int64_t>(), points_->num_vertices() - 20);
}

TEST_F(PointDatasetTest, WhatIsNotThereIsRefused) {
  ExpectError([] { Dataset({}, {0, 99}); }, "points of face 99 of a database of 16");
  ExpectError([] { Dataset({.sampling = "samples"}); }, "sampling samples");
  ExpectError([] { Dataset({}).Get(std::vector<int>{3}); }, "sample 3 of a dataset of 3");
  ExpectError([] { Dataset({}).Vertices(std::vector<int>{-1}); }, "sample -1");
}

TEST_F(PointDatasetTest, PointsOfOtherFacesAreRefused) {
  const TempDir other;
  testing::BuildSyntheticFaces(other / "faces", 1);
  const faces::FaceDatabase others(other / "faces");
  ExpectError([&] { PointDataset(others, *points_, {0}, {}); }, "were not made of the faces");
}

}  // namespace
}  // namespace daumier::datasets
