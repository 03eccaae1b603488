#include "core/half.h"

#include "core/random.h"

#include <Eigen/Core>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace daumier {
namespace {

TEST(Half, HasTheBitsOfIeee754) {
  EXPECT_EQ(HalfFromFloat(0).bits, 0x0000);
  EXPECT_EQ(HalfFromFloat(-0.0F).bits, 0x8000);
  EXPECT_EQ(HalfFromFloat(1).bits, 0x3c00);
  EXPECT_EQ(HalfFromFloat(-2).bits, 0xc000);
  EXPECT_EQ(HalfFromFloat(65504).bits, 0x7bff);
  EXPECT_EQ(HalfFromFloat(65519).bits, 0x7bff);
  EXPECT_EQ(HalfFromFloat(65520).bits, 0x7c00);
  EXPECT_EQ(HalfFromFloat(-1e30F).bits, 0xfc00);
  EXPECT_EQ(HalfFromFloat(0x1p-24F).bits, 0x0001);
  EXPECT_EQ(HalfFromFloat(0x1p-25F).bits, 0x0000);  // Halfway to the even one.
  EXPECT_EQ(HalfFromFloat(0x1.8p-24F).bits, 0x0002);
  EXPECT_EQ(FloatFromHalf({0x7bff}), kLargestHalf);
  EXPECT_TRUE(std::isnan(FloatFromHalf(HalfFromFloat(std::numeric_limits<float>::quiet_NaN()))));
}

TEST(Half, FloatUndoesHalfOfEveryHalf) {
  for (uint32_t bits = 0; bits < 0x10000; ++bits) {
    const Half half{static_cast<uint16_t>(bits)};
    const float value = FloatFromHalf(half);
    if (std::isnan(value)) continue;
    ASSERT_EQ(HalfFromFloat(value), half) << bits;
    ASSERT_EQ(std::bit_cast<uint32_t>(value),
              std::bit_cast<uint32_t>(float(Eigen::numext::bit_cast<Eigen::half>(half.bits))))
        << bits;
  }
}

TEST(Half, RoundsAsEigenDoes) {
  Rng rng(3);
  for (int i = 0; i < 200'000; ++i) {
    const float value = std::bit_cast<float>(static_cast<uint32_t>(rng.Below(uint64_t{1} << 32)));
    if (std::isnan(value)) continue;
    ASSERT_EQ(HalfFromFloat(value).bits, Eigen::numext::bit_cast<uint16_t>(Eigen::half(value))) << value;
    const float middling = float(100 * rng.Normal());
    ASSERT_EQ(HalfFromFloat(middling).bits, Eigen::numext::bit_cast<uint16_t>(Eigen::half(middling))) << middling;
  }
}

TEST(Half, IsWithinHalfOfTheLastOf11Bits) {
  Rng rng(4);
  for (int i = 0; i < 10'000; ++i) {
    const float value = float(std::exp(4 * rng.Normal()));
    if (value > kLargestHalf || value < 0x1p-14F) continue;
    EXPECT_LE(std::abs(FloatFromHalf(HalfFromFloat(value)) - value), value * 0x1p-11F);
  }
}

}  // namespace
}  // namespace daumier
