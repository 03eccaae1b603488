#include "datasets/read/point_dataset.h"

#include "datasets/build/points.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>

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
  static geometry::Points Model(const geometry::Points& points_cm) { return points_->frame().FromCm(points_cm); }
  static geometry::Points Template() {
    const auto vertices = points_->template_vertices();
    geometry::Points points(points_->num_vertices(), 3);
    for (int v = 0; v < points.rows(); ++v)
      for (int k = 0; k < 3; ++k) points(v, k) = vertices[size_t(3 * v + k)];
    return points;
  }
  /// What the batch has for face `row` against the face's own mesh.
  static void ExpectPointsOf(const SampleBatch& batch, int64_t row, int face) {
    const geometry::Points on_template = Template(), on_face = Model(faces_->points(face));
    const int64_t* const corners = batch.indices.at("corners").row(row);
    const float *const weights = batch.arrays.at("weights").row(row),
                       *const positions = batch.arrays.at("positions").row(row),
                       *const targets = batch.arrays.at("targets").row(row);
    for (int64_t n = 0; n < batch.indices.at("corners").shape[1]; ++n) {
      for (int k = 0; k < 3; ++k) {
        double position = 0, target = 0;
        for (int64_t c = 3 * n; c < 3 * n + 3; ++c) {
          position += weights[c] * on_template(corners[c], k);
          target += weights[c] * on_face(corners[c], k);
        }
        ASSERT_NEAR(positions[3 * n + k], position, 1e-6) << n;
        ASSERT_NEAR(targets[3 * n + k], target, 1e-5) << n;
      }
    }
  }
  static bool Equal(const SampleBatch& a, const SampleBatch& b) {
    const auto same = [&](const char* name) { return a.arrays.at(name).values == b.arrays.at(name).values; };
    return Corners(a) == Corners(b) && same("weights") && same("positions") && same("targets");
  }
  static const std::vector<int64_t>& Corners(const SampleBatch& batch) { return batch.indices.at("corners").values; }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* faces_ = nullptr;
  static inline PointDatabase* points_ = nullptr;
};

TEST_F(PointDatasetTest, PointsLieInTheirTrianglesOnTemplateAndFace) {
  const SampleBatch batch = Dataset({.num_points = 200}).Get(std::vector<int>{2, 0}, 3);
  EXPECT_EQ(batch.samples, (std::vector<int>{2, 0}));
  const std::vector<int64_t> shape{2, 200, 3};
  ASSERT_EQ(batch.indices.at("corners").shape, shape);
  for (const char* name : {"weights", "positions", "targets"}) ASSERT_EQ(batch.arrays.at(name).shape, shape);
  const std::vector<float>& weights = batch.arrays.at("weights").values;
  EXPECT_GE(std::ranges::min(weights), 0);
  for (size_t n = 0; n < 400; ++n) EXPECT_NEAR(weights[3 * n] + weights[3 * n + 1] + weights[3 * n + 2], 1, 1e-6);
  ExpectPointsOf(batch, 0, 5);
  ExpectPointsOf(batch, 1, 3);
}

TEST_F(PointDatasetTest, AllPointsAreTheVerticesAndThenTheSamples) {
  const SampleBatch batch = Dataset({.num_points = 0}).Get(std::vector<int>{1});
  const int64_t num_vertices = points_->num_vertices();
  ASSERT_EQ(batch.indices.at("corners").shape[1], num_vertices + 600);
  ExpectPointsOf(batch, 0, 11);
  const SurfaceSamples samples = points_->samples(11);
  for (const int s : {0, 77, 599}) {
    const size_t at = size_t(3 * (num_vertices + s));
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(Corners(batch)[at + size_t(k)], points_->face_template().triangles(samples.triangles[size_t(s)], k));
    EXPECT_EQ(batch.arrays.at("weights").values[at + 1], samples.weights[size_t(2 * s + 1)]);
  }
  const SampleBatch vertices = Dataset({.num_points = 0, .sampling = "vertices"}).Get(std::vector<int>{1});
  EXPECT_EQ(vertices.indices.at("corners").shape[1], num_vertices);
}

TEST_F(PointDatasetTest, VerticesAreAllVerticesInOrder) {
  const SampleBatch batch = Dataset({.num_points = 50}).Vertices(std::vector<int>{1, 2});
  const int64_t num_vertices = points_->num_vertices();
  ASSERT_EQ(batch.indices.at("corners").shape, (std::vector<int64_t>{2, num_vertices, 3}));
  for (const auto& [row, face] : {std::pair{0, 11}, {1, 5}}) {
    ExpectPointsOf(batch, row, face);
    for (int64_t n = 0; n < 3 * num_vertices; ++n) {
      ASSERT_EQ(batch.indices.at("corners").row(row)[n], n / 3);
      ASSERT_EQ(batch.arrays.at("weights").row(row)[n], n % 3 == 0 ? 1 : 0);
    }
  }
}

TEST_F(PointDatasetTest, ABatchIsAFunctionOfSeedFaceAndEpoch) {
  const PointReading reading{.num_points = 300};
  const PointDataset dataset = Dataset(reading);
  const SampleBatch alone = dataset.Get(std::vector<int>{1}, 4);
  EXPECT_TRUE(Equal(Dataset(reading, {0, 11}).Get(std::vector<int>{1}, 4), alone));
  const FloatArray all = dataset.Get(std::vector<int>{0, 1, 2}, 4).arrays.at("targets");
  EXPECT_EQ(std::vector<float>(all.row(1), all.row(2)), alone.arrays.at("targets").values);
  EXPECT_NE(Corners(dataset.Get(std::vector<int>{1}, 5)), Corners(alone));
  EXPECT_NE(Corners(Dataset(reading, {11}, 8).Get(std::vector<int>{0}, 4)), Corners(alone));
  EXPECT_NE(Corners(dataset.Get(std::vector<int>{0}, 4)), Corners(alone));
}

TEST_F(PointDatasetTest, HybridsTakeVerticesAndSamplesInTheirProportion) {
  const auto share_of_vertices = [](const SampleBatch& batch) {
    const std::vector<int64_t>& corners = Corners(batch);
    double count = 0;
    for (size_t n = 0; n < corners.size(); n += 3) count += corners[n] == corners[n + 1];
    return 3 * count / double(corners.size());
  };
  const std::vector<int> samples{0, 1, 2};
  const double expected = double(points_->num_vertices()) / (points_->num_vertices() + 600);
  EXPECT_NEAR(share_of_vertices(Dataset({.num_points = 4000}).Get(samples)), expected, 0.02);
  const SampleBatch vertices = Dataset({.num_points = 4000, .sampling = "vertices"}).Get(samples);
  EXPECT_EQ(share_of_vertices(vertices), 1);
  EXPECT_LT(std::ranges::min(Corners(vertices)), 20);
  EXPECT_GT(std::ranges::max(Corners(vertices)), points_->num_vertices() - 20);
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
