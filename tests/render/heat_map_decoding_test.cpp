#include "render/heat_map_decoding.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace daumier::render {
namespace {

/// Scores whose softmax is a Gaussian around (x, y).
std::vector<float> GaussianMap(int height, int width, double x, double y, double deviation) {
  std::vector<float> map;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      map.push_back(
          float(-0.5 * (std::pow(column + 0.5 - x, 2) + std::pow(row + 0.5 - y, 2)) / (deviation * deviation)));
  return map;
}

TEST(FindPeaks, FindsTheCentreOfAGaussianWithinAHundredthOfACell) {
  for (const double x : {9.0, 9.13, 9.5, 9.71, 10.02})
    for (const double y : {12.0, 12.38, 12.5, 12.99}) {
      const Peak peak = FindPeaks(GaussianMap(24, 20, x, y, 1.2), 1, 24, 20).front();
      EXPECT_NEAR(peak.x, x, 0.01);
      EXPECT_NEAR(peak.y, y, 0.01);
      EXPECT_NEAR(peak.confidence, 1, 0.01);
    }
}

TEST(FindPeaks, ASecondModeFarAwayMovesNothingAndLowersTheConfidence) {
  std::vector<float> map = GaussianMap(24, 24, 6.3, 6.6, 1.2);
  const std::vector<float> other = GaussianMap(24, 24, 18.5, 17.5, 1.2);
  for (size_t i = 0; i < map.size(); ++i) map[i] = float(std::log(0.7 * std::exp(map[i]) + 0.3 * std::exp(other[i])));
  const Peak peak = FindPeaks(map, 1, 24, 24).front();
  EXPECT_NEAR(peak.x, 6.3, 0.02);
  EXPECT_NEAR(peak.y, 6.6, 0.02);
  EXPECT_NEAR(peak.confidence, 0.7, 0.02);
}

TEST(FindPeaks, AFlatMapHasNoConfidence) {
  EXPECT_LT(FindPeaks(std::vector<float>(32 * 32, 0.5f), 1, 32, 32).front().confidence, 0.06);
}

TEST(FindPeaks, IsUnchangedByAConstantAndKeepsTheOrderOfMaps) {
  std::vector<float> maps = GaussianMap(8, 8, 2, 5, 1);
  for (const float score : GaussianMap(8, 8, 6, 3, 1)) maps.push_back(score + 100);
  const std::vector<Peak> peaks = FindPeaks(maps, 2, 8, 8, {.deviation = 1});
  EXPECT_LT(peaks[0].x, peaks[1].x);
  EXPECT_GT(peaks[0].y, peaks[1].y);
}

TEST(FindPeaks, RefusesAnotherNumberOfScores) {
  testing::ExpectError([] { FindPeaks(std::vector<float>(63), 1, 8, 8); }, "63 scores are no 1 maps of 8 x 8");
}

TEST(StateProbabilities, AreASoftmaxOfEachGroup) {
  const std::vector<float> scores = {0, float(std::log(3.0)), 5, 5, 5};
  const std::vector<int> classes = {2, 3};
  const auto states = StateProbabilities(scores, classes);
  EXPECT_NEAR(states[0][1], 0.75, 1e-6);
  for (const double p : states[1]) EXPECT_NEAR(p, 1.0 / 3, 1e-6);
  testing::ExpectError([&] { StateProbabilities(scores, std::vector<int>{2}); }, "5 scores of states, expected 2");
}

TEST(Likeliest, IsTheFirstOfTheGreatest) {
  EXPECT_EQ(Likeliest(std::array{0.2, 0.4, 0.4}), 1u);
  EXPECT_EQ(Likeliest({}), 0u);
}

TEST(AverageWithMirrored, OfMapsThatShowTheSameIsUnchanged) {
  // Map 0 and map 1 change places in the mirror.
  const std::vector<float> left = GaussianMap(6, 8, 2.2, 3, 1), right = GaussianMap(6, 8, 5.1, 2, 1);
  std::vector<float> maps = left, mirrored = GaussianMap(6, 8, 8 - 5.1, 2, 1);
  maps.insert(maps.end(), right.begin(), right.end());
  for (const float score : GaussianMap(6, 8, 8 - 2.2, 3, 1)) mirrored.push_back(score);
  const std::vector<float> before = maps;
  AverageWithMirrored(maps, mirrored, 6, 8, std::vector<int>{1, 0});
  for (size_t i = 0; i < maps.size(); ++i) EXPECT_NEAR(maps[i], before[i], 1e-5);
}

TEST(ScoreGrid, IsBilinearBetweenCentresAndContinuesBeyondTheBorder) {
  const std::vector<float> scores = {0, 1, 2, 3, 3, 2, 1, 0};  // Two classes of 2 x 2.
  const ScoreGrid grid(scores, 2, 2, 2);
  std::vector<float> at(2);
  grid.At(1, 1, at);
  EXPECT_FLOAT_EQ(at[0], 1.5f);
  EXPECT_FLOAT_EQ(at[1], 1.5f);
  grid.At(-3, 0.5, at);
  EXPECT_FLOAT_EQ(at[0], 0);
  EXPECT_EQ(grid.ClassAt(0.5, 0.5), 1);
  EXPECT_EQ(grid.ClassAt(1.5, 1.5), 0);
}

TEST(ScoreGrid, TheClassIsThatOfTheHighestScoreEverywhere) {
  constexpr int kClasses = 4, kHeight = 5, kWidth = 6;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> number(-1, 1);
  std::vector<float> scores(kClasses * kHeight * kWidth), at(kClasses);
  for (float& score : scores) score = number(random);
  for (int cell = 0; cell < 12; ++cell) scores[size_t(cell)] += 3;  // One class leads in two rows.
  const ScoreGrid grid(scores, kClasses, kHeight, kWidth);
  for (double y = -0.7; y < kHeight + 1; y += 0.13)
    for (double x = -0.7; x < kWidth + 1; x += 0.17) {
      grid.At(x, y, at);
      EXPECT_EQ(grid.ClassAt(x, y), std::ranges::max_element(at) - at.begin()) << x << ", " << y;
    }
}

TEST(ScoreGrid, MarginIsTheLeadOverTheHighestOther) {
  const std::vector<float> scores = {4, 1, 2, 3, 3, 0};  // Three classes of 1 x 2.
  EXPECT_EQ(ScoreGrid(scores, 3, 1, 2).Margin(0), (std::vector<float>{1, -2}));
}

}  // namespace
}  // namespace daumier::render
