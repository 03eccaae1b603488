#include "systems/portrait/landmark_views.h"

#include "tests/support/drawn_portraits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::portrait {
namespace {

bool IsPicture(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return value >= 0 && value <= 1; });
}

TEST(TrainingView, WithoutAugmentationHoldsTheFaceUprightAndCentred) {
  const LandmarkSample sample = testing::DrawnPortraits(4).Get(1);
  Rng rng(1);
  const TrainingView view = MakeTrainingView(sample, {.size = 128}, nullptr, rng);
  const Box box = BoxOf(view.points);
  EXPECT_NEAR(box.side(), 32 / kCropSide, 0.01);  // Cells of the heat maps.
  EXPECT_NEAR((box.centre() - Eigen::Vector2d(16, 16)).norm(), 0, 0.01);
  EXPECT_EQ(view.states[0], 1);
  EXPECT_EQ(std::ranges::count(view.weights, 1.0f) + std::ranges::count(view.weights, 0.5f), 68);
}

TEST(TrainingView, OfTheMirrorIsTheMirrorOfTheView) {
  // The picture's own mirror image, its landmarks in the order of the mirror: the flipped view of it is that of the picture.
  const LandmarkSample sample = testing::DrawnPortraits(6).Get(3);
  LandmarkSample mirror = sample;
  for (int row = 0; row < 224; ++row)
    for (int column = 0; column < 224; ++column) {
      mirror.mask.at(row, column) = sample.mask.at(row, 223 - column);
      for (int k = 0; k < 3; ++k) mirror.picture.at(row, column, k) = sample.picture.at(row, 223 - column, k);
    }
  for (int i = 0; i < 68; ++i) {
    const auto from = size_t(MirroredLandmarks()[size_t(i)]);
    mirror.landmarks[2 * size_t(i)] = 224 - sample.landmarks[2 * from];
    mirror.landmarks[2 * size_t(i) + 1] = sample.landmarks[2 * from + 1];
    mirror.visibility[size_t(i)] = sample.visibility[from];
  }
  std::swap(mirror.gaps_mm[0], mirror.gaps_mm[1]);
  LandmarkAugmentationOptions still{.shift = 0,
                                    .scale = 0,
                                    .rotation_degrees = 0,
                                    .flip = 1,
                                    .stretch = 0,
                                    .bulges = 0,
                                    .teeth = 0,
                                    .colour = 0,
                                    .tint = 0,
                                    .grey = 0,
                                    .contrast = 0,
                                    .posterise = 0,
                                    .blur = 0,
                                    .coarse = 0,
                                    .occluder = 0,
                                    .noise = 0,
                                    .jpeg = 0,
                                    .line_drawing = 0};
  Rng rng(1), again(1);
  const ViewOptions options{.size = 64, .negative_share = 0};
  const TrainingView flipped = MakeTrainingView(mirror, options, &still, rng);
  const TrainingView plain = MakeTrainingView(sample, options, nullptr, again);
  for (size_t i = 0; i < plain.points.size(); ++i) EXPECT_NEAR(flipped.points[i], plain.points[i], 1e-3);
  EXPECT_EQ(flipped.states, plain.states);
  int64_t different = 0;
  for (size_t i = 0; i < plain.labels.size(); ++i) different += flipped.labels[i] != plain.labels[i];
  EXPECT_LT(different, 20);  // Of 1024: borders of a pixel.
}

TEST(TrainingView, IsAFunctionOfTheStateOfTheGenerator) {
  const LandmarkSample sample = testing::DrawnPortraits(4).Get(2);
  const LandmarkAugmentationOptions augmentation;
  for (uint64_t seed = 0; seed < 40; ++seed) {
    Rng a(seed), b(seed);
    const TrainingView first = MakeTrainingView(sample, {.size = 64}, &augmentation, a),
                       second = MakeTrainingView(sample, {.size = 64}, &augmentation, b);
    EXPECT_EQ(first.picture, second.picture);
    EXPECT_EQ(first.labels, second.labels);
    EXPECT_TRUE(IsPicture(first.picture));
    for (size_t i = 0; i < 68; ++i) {
      if (first.weights[i] == 0) continue;
      EXPECT_TRUE(first.points[2 * i] >= 0 && first.points[2 * i] <= 16);
      EXPECT_TRUE(first.points[2 * i + 1] >= 0 && first.points[2 * i + 1] <= 16);
    }
  }
}

TEST(TrainingView, NegativesHaveNoLandmarksAndSaySo) {
  const LandmarkSample sample = testing::DrawnPortraits(4).Get(2);
  const LandmarkAugmentationOptions augmentation;
  Rng rng(5);
  int num_boxes = 0;
  for (int i = 0; i < 40; ++i) {
    const TrainingView view = MakeTrainingView(sample, {.size = 64, .negative_share = 1}, &augmentation, rng);
    EXPECT_EQ(view.states[0], 0);
    EXPECT_EQ(std::ranges::max(view.weights), 0);
    const float score = std::ranges::max(view.search.score);
    EXPECT_TRUE(score == 0 || score == 1);
    num_boxes += score == 1;
  }
  EXPECT_GT(num_boxes, 0);  // Small faces, which the search has to find.
  EXPECT_LT(num_boxes, 20);
}

TEST(SearchTargets, MarkTheCentreAndTheSizeOfABox) {
  const Box box{20, 40, 60, 80};
  const SearchTargets targets = MakeSearchTargets({&box, 1}, 128);  // 16 x 16 cells of 8 pixels.
  const size_t at = 7 * 16 + 5;
  EXPECT_EQ(targets.score[at], 1);
  EXPECT_EQ(std::ranges::count(targets.score, 1.0f), 1);
  EXPECT_EQ(targets.weight[at], 1);
  EXPECT_FLOAT_EQ(targets.box[at], -0.5f);
  EXPECT_FLOAT_EQ(targets.box[256 + at], 0);
  EXPECT_FLOAT_EQ(targets.box[512 + at], std::log(5.0f));
  EXPECT_EQ(std::ranges::max(MakeSearchTargets({}, 128).score), 0);
}

TEST(Scene, ShowsItsFacesWhereTheSearchMapSays) {
  const testing::DrawnPortraits portraits(4);
  const LandmarkSample a = portraits.Get(0), b = portraits.Get(1);
  Rng rng(3);
  LandmarkAugmentationOptions still;
  still.strength = 0;
  const std::vector<const LandmarkSample*> both = {&a, &b};
  int most = 0;
  for (int i = 0; i < 10; ++i) {
    const TrainingView scene = MakeScene(both, {.size = 128}, still, rng);
    const int faces = int(std::ranges::count(scene.search.score, 1.0f));
    EXPECT_GE(faces, 1);
    most = std::max(most, faces);
    EXPECT_TRUE(IsPicture(scene.picture));
  }
  EXPECT_EQ(most, 2);
  EXPECT_EQ(std::ranges::max(MakeScene({}, {.size = 128}, still, rng).search.score), 0);
}

}  // namespace
}  // namespace daumier::portrait
