#include "datasets/read/stroke_removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

/// Straight strokes of some lengths in widths of the canvas.
std::vector<render::Stroke> LinesOfLengths(const std::vector<double>& lengths) {
  std::vector<render::Stroke> strokes;
  for (const double length : lengths) strokes.push_back({0, {{0, 0}, {static_cast<float>(256 * length), 0}}});
  return strokes;
}

constexpr int kDraws = 20000;

TEST(DrawRemovedStrokes, FrequenciesFollowTheWeights) {
  const std::vector<double> lengths{0.5, 0.1, 0.4, 1.2};
  const auto strokes = LinesOfLengths(lengths);
  std::vector<double> expected;
  double total = 0;
  for (size_t i = 0; i < 4; ++i) total += expected.emplace_back(std::exp(0.5 * double(i) - 2 * lengths[i]));
  std::vector<int> counts(4, 0);
  Rng rng(1);
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto removed = DrawRemovedStrokes(strokes, 1, 0.5, 2, rng);
    for (size_t i = 0; i < 4; ++i) counts[i] += removed[i];
  }
  double chi_square = 0;
  for (size_t i = 0; i < 4; ++i) {
    const double mean = kDraws * expected[i] / total;
    chi_square += (counts[i] - mean) * (counts[i] - mean) / mean;
  }
  EXPECT_LT(chi_square, 16.3);  // Exceeded by chance once in a thousand, with three degrees of freedom.
}

TEST(DrawRemovedStrokes, DrawsOneAfterTheOtherWithoutReplacement) {
  // P = (1, e, e^2) / S: stroke 0 stays with probability P1 P2 / (1 - P1) + P2 P1 / (1 - P2).
  const auto strokes = LinesOfLengths({0, 0, 0});
  const double sum = 1 + std::exp(1) + std::exp(2), p1 = std::exp(1) / sum, p2 = std::exp(2) / sum;
  const double stays = p1 * p2 / (1 - p1) + p2 * p1 / (1 - p2);
  int count = 0;
  Rng rng(2);
  for (int draw = 0; draw < kDraws; ++draw) count += !DrawRemovedStrokes(strokes, 2, 1, 0, rng)[0];
  EXPECT_NEAR(double(count) / kDraws, stays, 4 * std::sqrt(stays * (1 - stays) / kDraws));
}

TEST(DrawRemovedStrokes, RemovesTheRequestedNumberButNeverAll) {
  const auto strokes = LinesOfLengths({0.1, 0.2, 0.3, 0.4, 0.5});
  Rng rng(3);
  for (int count = -1; count <= 7; ++count) {
    const auto removed = DrawRemovedStrokes(strokes, count, 0.5, 2, rng);
    EXPECT_EQ(std::count(removed.begin(), removed.end(), true), std::clamp(count, 0, 4));
  }
  EXPECT_EQ(DrawRemovedStrokes(LinesOfLengths({0.1}), 1, 0.5, 2, rng), std::vector<bool>{false});
  EXPECT_TRUE(DrawRemovedStrokes({}, 1, 0.5, 2, rng).empty());
}

TEST(DrawRemovedStrokes, WeightsDoNotUnderflow) {
  // exp(-100 * 100) is 0 in double precision; the shorter stroke is e^100 times as likely.
  Rng rng(4);
  for (int draw = 0; draw < 50; ++draw)
    EXPECT_EQ(DrawRemovedStrokes(LinesOfLengths({101, 100, 101}), 1, 0, 100, rng),
              (std::vector<bool>{false, true, false}));
}

}  // namespace
}  // namespace daumier::datasets
