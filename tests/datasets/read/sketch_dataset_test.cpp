#include "datasets/read/sketch_dataset.h"

#include "core/files.h"
#include "datasets/read/shape_numbers.h"
#include "datasets/read/training_fit.h"
#include "faces/face_database.h"
#include "render/stroke_samples.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <torch/types.h>

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

TEST_F(SketchDatasetTest, ImagesAreTheRasterisedStrokesWithInkOne) {
  const SketchDataset dataset(*sketches_, {3, 11, 5}, {.resolution = 64});
  const SketchBatch batch = dataset.Get(std::vector<int>{2, 0});
  ASSERT_EQ(batch.images.sizes(), (std::vector<int64_t>{2, 1, 64, 64}));
  EXPECT_EQ(batch.images.scalar_type(), torch::kFloat32);
  EXPECT_EQ(batch.images.suggest_memory_format(), torch::MemoryFormat::ChannelsLast);
  EXPECT_EQ(batch.faces[0].item<int64_t>(), 5);
  EXPECT_EQ(batch.faces[1].item<int64_t>(), 3);
  for (const auto& [row, face] : {std::pair{0, 5}, {1, 3}}) {
    const render::Image image = render::RasteriseStrokes(sketches_->strokes(face), 64);
    for (const auto& [y, x] : {std::pair{32, 32}, {20, 40}, {45, 30}, {0, 0}}) {
      EXPECT_FLOAT_EQ(batch.images[row][0][y][x].item<float>(), 1 - image.at(y, x) / 255.0f);
    }
  }
  EXPECT_GT(batch.images.max().item<float>(), 0.5f);  // Lines are 0.4 pixels wide at this size.
  EXPECT_EQ(batch.images.min().item<float>(), 0.0f);
  EXPECT_LT(batch.images.mean().item<float>(), 0.3f);  // Mostly paper.
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
  WriteManifest(folder.path(), manifest);
  const torch::Tensor image =
      SketchDataset(SketchDatabase(folder.path()), {0}, {.resolution = 256}).Get(std::vector<int>{0}).images;
  EXPECT_EQ(image[0][0][127][100].item<float>(), 1.0f);
  EXPECT_EQ(image[0][0][100][100].item<float>(), 0.0f);
  EXPECT_EQ(image[0][0][160][100].item<float>(), 0.0f);
}

TEST_F(SketchDatasetTest, ABatchDoesNotDependOnWhatElseIsCached) {
  std::vector<int> all(sketches_->num_faces());
  std::iota(all.begin(), all.end(), 0);
  const SketchDataset whole(*sketches_, all, {.resolution = 32}), one(*sketches_, {9}, {.resolution = 32});
  EXPECT_TRUE(torch::equal(whole.Get(std::vector<int>{9}).images, one.Get(std::vector<int>{0}).images));
  EXPECT_EQ(whole.size(), sketches_->num_faces());
}

SketchVariation Strength(double strength) {
  SketchVariation variation;
  variation.augmentation.strength = strength;
  return variation;
}

TEST_F(SketchDatasetTest, AnAugmentedPictureIsAFunctionOfSeedFaceAndEpoch) {
  const SketchDataset dataset(*sketches_, {3, 11, 5, 7, 2}, {.resolution = 64}, Strength(1), 9);
  const torch::Tensor image = dataset.Get(std::vector<int>{2}, 4).images[0];
  const SketchBatch all = dataset.Get(std::vector<int>{4, 3, 2, 1, 0}, 4);
  EXPECT_TRUE(torch::equal(all.images[2], image));
  EXPECT_EQ(all.faces[2].item<int64_t>(), 5);
  const SketchDataset others(*sketches_, {5, 1}, {.resolution = 64}, Strength(1), 9),
      other_seed(*sketches_, {5}, {.resolution = 64}, Strength(1), 8);
  EXPECT_TRUE(torch::equal(others.Get(std::vector<int>{0}, 4).images[0], image));
  EXPECT_FALSE(torch::equal(other_seed.Get(std::vector<int>{0}, 4).images[0], image));
  EXPECT_FALSE(torch::equal(dataset.Get(std::vector<int>{2}, 5).images[0], image));
}

TEST_F(SketchDatasetTest, AnAugmentedPictureDoesNotDependOnTheNumberOfCores) {
  const SketchDataset dataset(*sketches_, {3, 11, 5, 7, 2}, {.resolution = 64}, Strength(1), 9);
  const std::vector<int> samples{0, 1, 2, 3, 4};
  const torch::Tensor images = dataset.Get(samples, 1).images;
  cpu_set_t before, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  const torch::Tensor by_one_core = dataset.Get(samples, 1).images;
  ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
  EXPECT_TRUE(torch::equal(images, by_one_core));
}

TEST_F(SketchDatasetTest, AnAugmentedPictureIsTheAugmentedStrokesWithInkOne) {
  const SketchDataset dataset(*sketches_, {3}, {.resolution = 64}, Strength(1), 9);
  const AugmentedSketch sketch = VariedSketch(*sketches_, 3, Strength(1), 9, 6);
  const render::Image drawn = render::RasteriseStrokes(sketch.strokes, 64, sketch.style);
  const torch::Tensor image = dataset.Get(std::vector<int>{0}, 6).images[0][0];
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) ASSERT_FLOAT_EQ(image[y][x].item<float>(), 1 - drawn.at(y, x) / 255.0f);
  }
}

TEST_F(SketchDatasetTest, WithoutAugmentationEveryEpochIsTheSame) {
  const SketchDataset dataset(*sketches_, {3, 5}, {.resolution = 32}),
      zero(*sketches_, {3, 5}, {.resolution = 32}, Strength(0), 9);
  const std::vector<int> samples{0, 1};
  EXPECT_TRUE(torch::equal(dataset.Get(samples, 0).images, dataset.Get(samples, 7).images));
  EXPECT_TRUE(torch::equal(dataset.Get(samples).images, zero.Get(samples, 3).images));
}

TEST_F(SketchDatasetTest, WhatIsNotThereIsRefused) {
  ExpectError([&] { SketchDataset(*sketches_, {0, 99}, {.resolution = 32}); }, "sketch 99");
  ExpectError([&] { SketchDataset(*sketches_, {0, 99}, {.resolution = 32}, Strength(1)); }, "sketch 99");
  const SketchDataset dataset(*sketches_, {0, 1}, {.resolution = 32});
  ExpectError([&] { dataset.Get(std::vector<int>{2}); }, "sample 2 of a dataset of 2");
}

TEST_F(SketchDatasetTest, PointsAreSampledAlongTheStrokesOfTheSketch) {
  const SketchDataset dataset(*sketches_, {3, 11}, {.num_points = 40}, Strength(1), 9);
  const torch::Tensor points = dataset.Get(std::vector<int>{1}, 2).points;
  ASSERT_EQ(points.sizes().vec(), (std::vector<int64_t>{1, 4, 40}));
  const auto samples = render::SampleStrokes(VariedSketch(*sketches_, 11, Strength(1), 9, 2).strokes, 40);
  for (int64_t i = 0; i < 40; ++i) {
    EXPECT_NEAR(points[0][0][i].item<float>(), samples[size_t(i)].x / 128 - 1, 1e-6);
    EXPECT_NEAR(points[0][1][i].item<float>(), samples[size_t(i)].y / 128 - 1, 1e-6);
    EXPECT_EQ(points[0][2][i].item<float>(), samples[size_t(i)].cos_double);
    EXPECT_EQ(points[0][3][i].item<float>(), samples[size_t(i)].sin_double);
  }
  EXPECT_FALSE(dataset.Get(std::vector<int>{1}).images.defined());
  EXPECT_FALSE(dataset.Get(std::vector<int>{1}).shape.defined());
}

TEST_F(SketchDatasetTest, ShapeIsGivenByTheSketchAsItIsAugmented) {
  const faces::FaceDatabase faces(*folder_ / "faces");
  Split all;
  for (int face = 0; face < faces.num_faces(); ++face) all.train.push_back(face);
  const auto curves = FitCurvesOnTraining(faces, *sketches_, all, {.num_identity = 4, .num_expression = 3}).model;
  const faces::CurveEncoder encoder(curves);
  const SketchDataset dataset(*sketches_, {3, 11}, {.encoder = &encoder}, Strength(1), 9);
  const torch::Tensor shape = dataset.Get(std::vector<int>{1}, 2).shape;
  const AugmentedSketch sketch = VariedSketch(*sketches_, 11, Strength(1), 9, 2);
  const auto expected = GivenShape(encoder, *sketches_, sketch.moved, sketch.visible).numbers();
  ASSERT_EQ(shape.sizes().vec(), (std::vector<int64_t>{1, 7}));
  for (int k = 0; k < 7; ++k) EXPECT_EQ(shape[0][k].item<float>(), expected[k]);
}

TEST_F(SketchDatasetTest, FixedOnesShowTheFirstEpochInEachEpoch) {
  const SketchDataset dataset(*sketches_, {3, 11}, {.resolution = 32, .fixed = true}, Strength(1), 9),
      varying(*sketches_, {3, 11}, {.resolution = 32}, Strength(1), 9);
  const std::vector<int> samples{0, 1};
  EXPECT_TRUE(torch::equal(dataset.Get(samples, 5).images, dataset.Get(samples, 0).images));
  EXPECT_TRUE(torch::equal(dataset.Get(samples, 5).images, varying.Get(samples, 0).images));
}

}  // namespace
}  // namespace daumier::datasets
