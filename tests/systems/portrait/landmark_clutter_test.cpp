#include "systems/portrait/landmark_clutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <vector>

namespace daumier::portrait {
namespace {

bool AreShares(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return value >= 0 && value <= 1; });
}

TEST(Clutter, IsAPictureAndDiffersFromDrawToDraw) {
  Rng rng(2);
  std::vector<float> first(3 * 64 * 64), second = first;
  DrawClutter(first, 64, rng);
  DrawClutter(second, 64, rng);
  EXPECT_TRUE(AreShares(first));
  EXPECT_NE(first, second);
}

TEST(ShuffleBlocks, KeepsAllValues) {
  std::vector<float> picture(3 * 32 * 32);
  for (size_t i = 0; i < picture.size(); ++i) picture[i] = float(i);
  std::vector<float> shuffled = picture;
  Rng rng(2);
  ShuffleBlocks(shuffled, 32, rng);
  EXPECT_NE(shuffled, picture);
  std::ranges::sort(shuffled);
  EXPECT_EQ(shuffled, picture);
}

}  // namespace
}  // namespace daumier::portrait
