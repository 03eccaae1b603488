#include "core/random.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace daumier {
namespace {

TEST(Rng, GivesTheReferenceSequence) {
  // By hand from the definition of xoshiro256**: state 1 2 3 4 begins rotl(2 * 5, 7) * 9, and the next has state[1] =
  // 0.
  Rng rng(Rng::State{1, 2, 3, 4});
  EXPECT_EQ(rng.Bits(), 11520u);
  EXPECT_EQ(rng.Bits(), 0u);
  EXPECT_EQ(rng.Bits(), 1509978240u);
  EXPECT_EQ(rng.Bits(), 1215971899390074240u);
}

TEST(Rng, SeedIsSpreadBySplitMix64) {
  // The published first outputs of SplitMix64 with seed 0.
  const Rng rng(0);
  EXPECT_EQ(rng.state()[0], 0xe220a8397b1dcdafu);
  EXPECT_EQ(rng.state()[1], 0x6e789e6aa1b965f4u);
}

TEST(Rng, ContinuesFromItsState) {
  Rng rng(3);
  rng.Normal();
  Rng copy(rng.state());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(rng.Bits(), copy.Bits());
}

TEST(Rng, UniformStaysBelowItsEnd) {
  Rng rng(1);
  double sum = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value = rng.Uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    sum += value;
  }
  EXPECT_NEAR(sum / 100000, 0.5, 0.005);
}

TEST(Rng, UniformRangeIsHalfOpenEvenWhenRounding) {
  Rng rng(2);
  const double low = 1,
               high = std::nextafter(std::nextafter(1.0, 2.0), 2.0);  // Half of all sums would round to `high`.
  for (int i = 0; i < 1000; ++i) {
    const double value = rng.Uniform(low, high);
    ASSERT_GE(value, low);
    ASSERT_LT(value, high);
  }
}

TEST(Rng, NormalHasTheMomentsOfTheStandardNormal) {
  Rng rng(4);
  double sum = 0, squares = 0, fourths = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double value = rng.Normal();
    sum += value;
    squares += value * value;
    fourths += value * value * value * value;
  }
  EXPECT_NEAR(sum / kCount, 0, 0.01);
  EXPECT_NEAR(squares / kCount, 1, 0.015);
  EXPECT_NEAR(fourths / kCount, 3, 0.1);
}

TEST(Rng, NormalUsesTwoDrawsAndKeepsNothing) {
  Rng a(5), b(5);
  a.Normal();
  b.Bits();
  b.Bits();
  EXPECT_EQ(a.state(), b.state());
}

TEST(Rng, BelowIsUniform) {
  Rng rng(6);
  std::array<int, 3> counts = {};
  for (int i = 0; i < 30000; ++i) ++counts.at(rng.Below(3));
  for (const int count : counts) EXPECT_NEAR(count, 10000, 300);
}

TEST(Rng, BelowHasNoModuloBias) {
  // Of 3 * 2^62 values, plain modulo would give the lowest third twice as often as the others.
  Rng rng(7);
  const uint64_t third = uint64_t{1} << 62;
  int num_low = 0;
  for (int i = 0; i < 30000; ++i) num_low += rng.Below(3 * third) < third ? 1 : 0;
  EXPECT_NEAR(num_low, 10000, 300);
}

TEST(Rng, BelowZeroThrows) {
  Rng rng(8);
  EXPECT_THROW(rng.Below(0), Error);
  EXPECT_EQ(rng.Below(1), 0u);
}

TEST(Rng, PermutationHoldsEachOnce) {
  Rng rng(9);
  std::vector<int> order = rng.Permutation(50);
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
  std::sort(order.begin(), order.end());
  for (int i = 0; i < 50; ++i) EXPECT_EQ(order[i], i);
  EXPECT_TRUE(rng.Permutation(0).empty());
  EXPECT_THROW(rng.Permutation(-1), Error);
}

TEST(Rng, AllPermutationsAreEquallyLikely) {
  Rng rng(10);
  std::map<std::vector<int>, int> counts;
  for (int i = 0; i < 6000; ++i) ++counts[rng.Permutation(3)];
  EXPECT_EQ(counts.size(), 6u);
  for (const auto& [order, count] : counts) EXPECT_NEAR(count, 1000, 150);
}

TEST(Stream, RepeatsForTheSameSeedPurposeAndIndex) {
  EXPECT_EQ(Stream(1, "identities", 4).state(), Stream(1, "identities", 4).state());
}

TEST(Stream, DiffersInSeedPurposeAndIndex) {
  std::set<uint64_t> firsts;
  for (uint64_t seed = 0; seed < 10; ++seed) {
    for (const char* purpose : {"", "a", "b", "ab", "ba", "aa"}) {
      for (uint64_t index = 0; index < 50; ++index) firsts.insert(Stream(seed, purpose, index).Bits());
    }
  }
  EXPECT_EQ(firsts.size(), 10u * 6u * 50u);
}

TEST(Stream, NeighboursAreUncorrelated) {
  double sum = 0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) sum += Stream(1, "x", i).Normal() * Stream(1, "x", i + 1).Normal();
  EXPECT_NEAR(sum / kCount, 0, 0.03);
}

}  // namespace
}  // namespace daumier
