#include "datasets/read/point_dataset.h"

#include "datasets/build/points.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

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
  static geometry::Points Model(int face) { return points_->frame().FromCm(faces_->points(face)); }
  static Eigen::RowVector3d OnTemplate(int64_t vertex) {
    const std::span<const float> open = points_->template_vertices();
    return {open[size_t(3 * vertex)], open[size_t(3 * vertex + 1)], open[size_t(3 * vertex + 2)]};
  }
  /// Three numbers of point n of face `row`.
  template <class T>
  static std::array<T, 3> Triple(const Array<T>& array, int64_t row, int64_t n) {
    const T* const first = array.row(row) + 3 * n;
    return {first[0], first[1], first[2]};
  }
  static std::array<float, 3> Triple(const SampleBatch& batch, const char* name, int64_t row, int64_t n) {
    return Triple(batch.arrays.at(name), row, n);
  }
  static std::array<int64_t, 3> Corners(const SampleBatch& batch, int64_t row, int64_t n) {
    return Triple(batch.indices.at("corners"), row, n);
  }
  /// The points of `row` are those that corners and weights give on the template and on the face.
  static void ExpectPointsOf(const SampleBatch& batch, int64_t row, int face) {
    const geometry::Points model = Model(face);
    for (int64_t n = 0; n < batch.arrays.at("weights").shape[1]; ++n) {
      const auto corners = Corners(batch, row, n);
      const auto weights = Triple(batch, "weights", row, n);
      Eigen::RowVector3d position = Eigen::RowVector3d::Zero(), target = position;
      for (size_t c = 0; c < 3; ++c) {
        position += double(weights[c]) * OnTemplate(corners[c]);
        target += double(weights[c]) * model.row(corners[c]);
      }
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(Triple(batch, "positions", row, n)[size_t(k)], position[k], 1e-6);
        ASSERT_NEAR(Triple(batch, "targets", row, n)[size_t(k)], target[k], 1e-5);
      }
    }
  }
  static bool Equal(const SampleBatch& a, const SampleBatch& b) {
    const auto same = [&](const char* name) { return a.arrays.at(name).values == b.arrays.at(name).values; };
    return a.indices.at("corners").values == b.indices.at("corners").values && same("weights") && same("positions") &&
           same("targets");
  }

  static inline TempDir* folder_ = nullptr;
  static inline faces::FaceDatabase* faces_ = nullptr;
  static inline PointDatabase* points_ = nullptr;
};

TEST_F(PointDatasetTest, PointsLieInTheirTrianglesOnTemplateAndFace) {
  const SampleBatch batch = Dataset({.num_points = 200}).Get(std::vector<int>{2, 0}, 3);
  const std::vector<int64_t> shape{2, 200, 3};
  EXPECT_EQ(batch.indices.at("corners").shape, shape);
  for (const char* name : {"weights", "positions", "targets"}) EXPECT_EQ(batch.arrays.at(name).shape, shape);
  EXPECT_EQ(batch.samples, (std::vector<int>{2, 0}));
  for (int64_t n = 0; n < 200; ++n) {
    const auto weights = Triple(batch, "weights", 1, n);
    EXPECT_GE(std::min({weights[0], weights[1], weights[2]}), 0);
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-6);
  }
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
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(Corners(batch, 0, num_vertices + s)[size_t(k)],
                points_->face_template().triangles(samples.triangles[size_t(s)], k));
    EXPECT_EQ(Triple(batch, "weights", 0, num_vertices + s)[1], samples.weights[size_t(2 * s + 1)]);
  }
  const SampleBatch vertices = Dataset({.num_points = 0, .sampling = "vertices"}).Get(std::vector<int>{1});
  EXPECT_EQ(vertices.indices.at("corners").shape[1], num_vertices);
}

TEST_F(PointDatasetTest, VerticesAreAllVerticesInOrder) {
  const SampleBatch batch = Dataset({.num_points = 50}).Vertices(std::vector<int>{1, 2});
  for (const auto& [row, face] : {std::pair{0, 11}, {1, 5}}) {
    for (int64_t n = 0; n < points_->num_vertices(); ++n) {
      EXPECT_EQ(Corners(batch, row, n), (std::array<int64_t, 3>{n, n, n}));
      EXPECT_EQ(Triple(batch, "weights", row, n), (std::array<float, 3>{1, 0, 0}));
    }
    ExpectPointsOf(batch, row, face);
  }
}

TEST_F(PointDatasetTest, ABatchIsAFunctionOfSeedFaceAndEpoch) {
  const PointReading reading{.num_points = 300};
  const PointDataset dataset = Dataset(reading);
  const SampleBatch alone = dataset.Get(std::vector<int>{1}, 4), all = dataset.Get(std::vector<int>{0, 1, 2}, 4);
  const auto corners = [](const SampleBatch& batch) { return batch.indices.at("corners").values; };
  EXPECT_TRUE(Equal(Dataset(reading, {0, 11}).Get(std::vector<int>{1}, 4), alone));
  for (int64_t n = 0; n < 300; ++n) EXPECT_EQ(Triple(all, "targets", 1, n), Triple(alone, "targets", 0, n));
  EXPECT_NE(corners(dataset.Get(std::vector<int>{1}, 5)), corners(alone));
  EXPECT_NE(corners(Dataset(reading, {11}, 8).Get(std::vector<int>{0}, 4)), corners(alone));
  EXPECT_NE(corners(dataset.Get(std::vector<int>{0}, 4)), corners(alone));
}

TEST_F(PointDatasetTest, MayBeReadFromSeveralThreads) {
  const PointDataset dataset = Dataset({.num_points = 300});
  const SampleBatch expected = dataset.Get(std::vector<int>{0, 1, 2}, 4);
  std::atomic<int> num_equal = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] { num_equal += Equal(dataset.Get(std::vector<int>{0, 1, 2}, 4), expected); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(num_equal, 4);
}

TEST_F(PointDatasetTest, HybridsTakeVerticesAndSamplesInTheirProportion) {
  const auto share_of_vertices = [](const SampleBatch& batch) {
    const std::vector<int64_t>& corners = batch.indices.at("corners").values;
    int64_t count = 0;
    for (size_t i = 0; i < corners.size(); i += 3) count += corners[i] == corners[i + 1];
    return double(count) / double(corners.size() / 3);
  };
  const std::vector<int> samples{0, 1, 2};
  const double expected = double(points_->num_vertices()) / (points_->num_vertices() + 600);
  EXPECT_NEAR(share_of_vertices(Dataset({.num_points = 4000}).Get(samples)), expected, 0.02);
  const SampleBatch vertices = Dataset({.num_points = 4000, .sampling = "vertices"}).Get(samples);
  EXPECT_EQ(share_of_vertices(vertices), 1);
  const auto [least, greatest] = std::ranges::minmax(vertices.indices.at("corners").values);
  EXPECT_LT(least, 20);
  EXPECT_GT(greatest, points_->num_vertices() - 20);
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
