#include "datasets/read/sketch_dataset.h"

#include "core/files.h"
#include "datasets/read/curve_coefficients.h"
#include "datasets/read/training_fit.h"
#include "faces/face_database.h"
#include "render/stroke_samples.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <numeric>
#include <thread>

namespace daumier::datasets {
namespace {

using testing::ExpectError;
using testing::TempDir;

class SketchDatasetTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 2);
    testing::BuildSyntheticSketches(*folder_ / "faces", *folder_ / "sketches");
    sketches_ = new SketchDatabase(*folder_ / "sketches");
  }
  static void TearDownTestSuite() {
    delete sketches_;
    delete folder_;
  }

  static inline TempDir* folder_ = nullptr;
  static inline SketchDatabase* sketches_ = nullptr;
};

using Shape = std::vector<int64_t>;

/// One sample of the array of that name.
std::vector<float> RowOf(const SampleBatch& batch, const char* name, int64_t row) {
  const FloatArray& array = batch.arrays.at(name);
  return {array.row(row), array.row(row) + array.row_size()};
}

std::vector<float> Images(const SampleBatch& batch) {
  return batch.arrays.at("images").values;
}

float At(const std::vector<float>& image, int side, int y, int x) {
  return image[size_t(y * side + x)];
}

TEST_F(SketchDatasetTest, ImagesAreTheRasterisedStrokesWithInkOne) {
  const SketchDataset dataset(*sketches_, {3, 11, 5}, {.resolution = 64});
  const SampleBatch batch = dataset.Get(std::vector<int>{2, 0});
  EXPECT_EQ(batch.samples, (std::vector<int>{2, 0}));
  ASSERT_EQ(batch.arrays.at("images").shape, (Shape{2, 1, 64, 64}));
  EXPECT_EQ(batch.indices.at("faces").values, (std::vector<int64_t>{5, 3}));
  for (const auto& [row, face] : {std::pair{0, 5}, {1, 3}}) {
    const render::Image drawn = render::RasteriseStrokes(sketches_->strokes(face), 64);
    const std::vector<float> image = RowOf(batch, "images", row);
    for (const auto& [y, x] : {std::pair{32, 32}, {20, 40}, {45, 30}, {0, 0}})
      EXPECT_FLOAT_EQ(At(image, 64, y, x), 1 - drawn.at(y, x) / 255.0f);
  }
  const std::vector<float> all = Images(batch);
  EXPECT_GT(std::ranges::max(all), 0.5f);  // Lines are 0.4 pixels wide at this size.
  EXPECT_EQ(std::ranges::min(all), 0.0f);
  EXPECT_LT(std::accumulate(all.begin(), all.end(), 0.0) / double(all.size()), 0.3);  // Mostly paper.
}

TEST_F(SketchDatasetTest, InkIsOneAndPaperIsZero) {
  const TempDir folder;
  MakeDirectory(folder / "shards");
  SafetensorsWriter writer;  // A line of 1.5 pixels through the middle row of 256 x 256, drawn at that size.
  writer.Add<float>("points", {2, 2}, std::vector<float>{0, 127.5, 256, 127.5});
  writer.Add<int64_t>("stroke_offsets", {2}, std::vector<int64_t>{0, 2});
  writer.Add<int32_t>("stroke_kinds", {1}, std::vector<int32_t>{0});
  writer.Add<int64_t>("sketch_offsets", {2}, std::vector<int64_t>{0, 1});
  writer.Write(folder / faces::PersonShardName(0));
  Manifest manifest;
  manifest.kind = "sketches";
  manifest.counts = {{"persons", 1}, {"faces", 1}, {"faces_per_shard", 1}, {"views_per_face", 1}};
  manifest.details = SketchDatabase(*folder_ / "sketches").manifest().details;
  manifest.details.erase("version");  // Without facts.
  WriteManifest(folder.path(), manifest);
  const std::vector<float> image =
      Images(SketchDataset(SketchDatabase(folder.path()), {0}, {.resolution = 256}).Get(std::vector<int>{0}));
  EXPECT_EQ(At(image, 256, 127, 100), 1.0f);
  EXPECT_EQ(At(image, 256, 100, 100), 0.0f);
  EXPECT_EQ(At(image, 256, 160, 100), 0.0f);
}

TEST_F(SketchDatasetTest, ABatchDoesNotDependOnWhatElseIsCached) {
  std::vector<int> all(sketches_->num_faces());
  std::iota(all.begin(), all.end(), 0);
  const SketchDataset whole(*sketches_, all, {.resolution = 32}), one(*sketches_, {9}, {.resolution = 32});
  EXPECT_EQ(Images(whole.Get(std::vector<int>{9})), Images(one.Get(std::vector<int>{0})));
  EXPECT_EQ(whole.size(), sketches_->num_faces());
}

SketchVariation StrengthOf(double strength) {
  SketchVariation variation;
  variation.augmentation.strength = strength;
  return variation;
}

TEST_F(SketchDatasetTest, AnAugmentedPictureIsAFunctionOfSeedFaceAndEpoch) {
  const SketchDataset dataset(*sketches_, {3, 11, 5, 7, 2}, {.resolution = 64}, StrengthOf(1), 9);
  const std::vector<float> image = Images(dataset.Get(std::vector<int>{2}, 4));
  const SampleBatch all = dataset.Get(std::vector<int>{4, 3, 2, 1, 0}, 4);
  EXPECT_EQ(RowOf(all, "images", 2), image);
  EXPECT_EQ(all.indices.at("faces").values[2], 5);
  const SketchDataset others(*sketches_, {5, 1}, {.resolution = 64}, StrengthOf(1), 9),
      other_seed(*sketches_, {5}, {.resolution = 64}, StrengthOf(1), 8);
  EXPECT_EQ(Images(others.Get(std::vector<int>{0}, 4)), image);
  EXPECT_NE(Images(other_seed.Get(std::vector<int>{0}, 4)), image);
  EXPECT_NE(Images(dataset.Get(std::vector<int>{2}, 5)), image);
}

TEST_F(SketchDatasetTest, GivesTheSameBatchesToSeveralThreads) {
  const SketchDataset dataset(*sketches_, {3, 11, 5, 7, 2}, {.resolution = 32, .num_points = 40}, StrengthOf(1), 9);
  std::vector<SampleBatch> batches(9);
  {
    std::vector<std::jthread> threads;
    for (size_t t = 0; t < 3; ++t)
      threads.emplace_back([&, t] {
        for (size_t i = t; i < batches.size(); i += 3) batches[i] = dataset.Get(std::vector<int>{4, 1}, int64_t(i));
      });
  }
  for (size_t i = 0; i < batches.size(); ++i) {
    const SampleBatch alone = dataset.Get(std::vector<int>{4, 1}, int64_t(i));
    EXPECT_EQ(Images(batches[i]), Images(alone));
    EXPECT_EQ(RowOf(batches[i], "points", 1), RowOf(alone, "points", 1));
  }
}

TEST_F(SketchDatasetTest, AnAugmentedPictureDoesNotDependOnTheNumberOfCores) {
  const SketchDataset dataset(*sketches_, {3, 11, 5, 7, 2}, {.resolution = 64}, StrengthOf(1), 9);
  const std::vector<int> samples{0, 1, 2, 3, 4};
  const std::vector<float> images = Images(dataset.Get(samples, 1));
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  const std::vector<float> by_one_core = Images(dataset.Get(samples, 1));
  ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
  EXPECT_EQ(images, by_one_core);
}

TEST_F(SketchDatasetTest, AnAugmentedPictureIsTheAugmentedStrokesWithInkOne) {
  const SketchDataset dataset(*sketches_, {3}, {.resolution = 64}, StrengthOf(1), 9);
  const AugmentedSketch sketch = VariedSketch(*sketches_, 3, StrengthOf(1), 9, 6);
  const render::Image drawn = render::RasteriseStrokes(sketch.strokes, 64, sketch.style);
  const std::vector<float> image = Images(dataset.Get(std::vector<int>{0}, 6));
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_FLOAT_EQ(At(image, 64, y, x), 1 - drawn.at(y, x) / 255.0f);
  }
}

TEST_F(SketchDatasetTest, WithoutAugmentationEveryEpochIsTheSame) {
  const SketchDataset dataset(*sketches_, {3, 5}, {.resolution = 32}),
      zero(*sketches_, {3, 5}, {.resolution = 32}, StrengthOf(0), 9);
  const std::vector<int> samples{0, 1};
  EXPECT_EQ(Images(dataset.Get(samples, 0)), Images(dataset.Get(samples, 7)));
  EXPECT_EQ(Images(dataset.Get(samples)), Images(zero.Get(samples, 3)));
}

TEST_F(SketchDatasetTest, WhatIsNotThereIsRefused) {
  ExpectError([&] { SketchDataset(*sketches_, {0, 99}, {.resolution = 32}); }, "sketch 99");
  ExpectError([&] { SketchDataset(*sketches_, {0, 99}, {.resolution = 32}, StrengthOf(1)); }, "sketch 99");
  const SketchDataset dataset(*sketches_, {0, 1}, {.resolution = 32});
  ExpectError([&] { dataset.Get(std::vector<int>{2}); }, "sample 2 of a dataset of 2");
}

TEST_F(SketchDatasetTest, PointsAreSampledAlongTheStrokesOfTheSketch) {
  const SketchDataset dataset(*sketches_, {3, 11}, {.num_points = 40}, StrengthOf(1), 9);
  const SampleBatch batch = dataset.Get(std::vector<int>{1}, 2);
  ASSERT_EQ(batch.arrays.at("points").shape, (Shape{1, 4, 40}));
  const std::vector<float> points = RowOf(batch, "points", 0);
  const auto samples = render::SampleStrokes(VariedSketch(*sketches_, 11, StrengthOf(1), 9, 2).strokes, 40);
  for (size_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(points[i], samples[i].x / 128 - 1, 1e-6);
    EXPECT_NEAR(points[40 + i], samples[i].y / 128 - 1, 1e-6);
    EXPECT_EQ(points[80 + i], samples[i].cos_double);
    EXPECT_EQ(points[120 + i], samples[i].sin_double);
  }
  EXPECT_FALSE(batch.arrays.contains("images"));
  EXPECT_FALSE(batch.arrays.contains("shape"));
}

TEST_F(SketchDatasetTest, ShapeIsGivenByTheSketchAsItIsAugmented) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  Split all;
  for (int face = 0; face < faces.num_faces(); ++face) all.train.push_back(face);
  const auto curves = FitCurvesOnTraining(faces, *sketches_, all, {.num_identity = 4, .num_expression = 3}).model;
  const faces::CurveEncoder encoder(curves);
  const SketchDataset dataset(*sketches_, {3, 11}, {.encoder = &encoder}, StrengthOf(1), 9);
  const FloatArray shape = dataset.Get(std::vector<int>{1}, 2).arrays.at("shape");
  const AugmentedSketch sketch = VariedSketch(*sketches_, 11, StrengthOf(1), 9, 2);
  const auto expected = GivenShape(encoder, *sketches_, sketch.moved, sketch.visible).numbers();
  ASSERT_EQ(shape.shape, (Shape{1, 7}));
  for (int k = 0; k < 7; ++k) EXPECT_EQ(shape.values[size_t(k)], expected[k]);
}

TEST_F(SketchDatasetTest, FixedOnesShowTheFirstEpochInEachEpoch) {
  const SketchDataset dataset(*sketches_, {3, 11}, {.resolution = 32, .fixed = true}, StrengthOf(1), 9),
      varying(*sketches_, {3, 11}, {.resolution = 32}, StrengthOf(1), 9);
  const std::vector<int> samples{0, 1};
  EXPECT_EQ(Images(dataset.Get(samples, 5)), Images(dataset.Get(samples, 0)));
  EXPECT_EQ(Images(dataset.Get(samples, 5)), Images(varying.Get(samples, 0)));
}

}  // namespace
}  // namespace daumier::datasets
