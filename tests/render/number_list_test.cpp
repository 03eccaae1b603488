#include "render/number_list.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::render {
namespace {

TEST(NumbersOf, AreSeparatedByWhiteSpace) {
  EXPECT_EQ(NumbersOf("1 -2.5\n\t3e2 .5\r\n"), (std::vector<double>{1, -2.5, 300, 0.5}));
  EXPECT_TRUE(NumbersOf("").empty());
  EXPECT_TRUE(NumbersOf(" \n").empty());
}

TEST(NumbersOf, RefusesWhatIsNoFiniteNumber) {
  for (const char* text : {"1 two", "1,5", "nan", "inf", "1e300", "0x10", "1-2"})
    testing::ExpectError([&] { NumbersOf(text); }, "is not a finite number");
}

}  // namespace
}  // namespace daumier::render
