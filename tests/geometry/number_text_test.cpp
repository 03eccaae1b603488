#include "geometry/number_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::geometry {
namespace {

TEST(ParseNumber, ReadsDecimalNumbers) {
  EXPECT_EQ(ParseNumber("0.5"), 0.5);
  EXPECT_EQ(ParseNumber("-2e-1"), -0.2);
  EXPECT_EQ(ParseNumber("+1.5"), 1.5);
  EXPECT_EQ(ParseNumber(".25"), 0.25);
  EXPECT_EQ(ParseNumber("3."), 3.0);
  EXPECT_EQ(ParseNumber("1E3"), 1000.0);
}

TEST(ParseNumber, ReadsWhatCLibrariesPrintOfNumbersThatAreNotFinite) {
  for (const char* word : {"nan", "-nan", "NaN", "NAN", "-nan(ind)", "nan(snan)", "1.#QNAN", "-1.#IND00", "1.#SNAN"}) {
    const auto number = ParseNumber(word);
    ASSERT_TRUE(number.has_value()) << word;
    EXPECT_TRUE(std::isnan(*number)) << word;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const char* word : {"inf", "+inf", "INF", "Infinity", "1.#INF", "1.#INF000"})
    EXPECT_EQ(ParseNumber(word), kInfinity) << word;
  EXPECT_EQ(ParseNumber("-inf"), -kInfinity);
  EXPECT_EQ(ParseNumber("-1.#INF"), -kInfinity);
}

TEST(ParseNumber, OutOfRangeIsInfiniteOrZero) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ParseNumber("1e999"), kInfinity);
  EXPECT_EQ(ParseNumber("-1e+999"), -kInfinity);
  EXPECT_EQ(ParseNumber("1" + std::string(400, '0')), kInfinity);
  EXPECT_EQ(ParseNumber("1e-999"), 0.0);
  EXPECT_EQ(ParseNumber("0." + std::string(400, '0') + "1"), 0.0);
}

TEST(ParseNumber, IsAbsentForOtherWords) {
  for (const char* word : {"", "+", "-", "+-1", "--1", "0,5", "1.5x", "x", "1.#", "1.#XYZ", "0x10", "1 2", "1e"})
    EXPECT_FALSE(ParseNumber(word).has_value()) << word;
}

}  // namespace
}  // namespace daumier::geometry
