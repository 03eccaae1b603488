#include "core/crc32c.h"

#include <gtest/gtest.h>

#include <string>

namespace daumier {
namespace {

TEST(Crc32c, HasTheStandardsValues) {
  EXPECT_EQ(Crc32c("123456789"), 0xe3069283u);
  EXPECT_EQ(Crc32c(""), 0u);
  // RFC 3720, appendix B.4: 32 bytes of zeros, of ones, and counting up.
  EXPECT_EQ(Crc32c(std::string(32, '\0')), 0x8a9136aau);
  EXPECT_EQ(Crc32c(std::string(32, '\xff')), 0x62a8ab43u);
  std::string counting;
  for (int i = 0; i < 32; ++i) counting += static_cast<char>(i);
  EXPECT_EQ(Crc32c(counting), 0x46dd794eu);
}

TEST(Crc32c, ChangesWithEveryBit) {
  const std::string text = "daumier";
  for (size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] ^= static_cast<char>(1 << bit % 8);
    EXPECT_NE(Crc32c(other), Crc32c(text));
  }
}

}  // namespace
}  // namespace daumier
