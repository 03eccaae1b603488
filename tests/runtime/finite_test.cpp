#include "runtime/finite.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace daumier::runtime {
namespace {

TEST(AreFinite, FindsEveryNumberThatIsNot) {
  std::vector<float> numbers(37, -std::numeric_limits<float>::max());
  EXPECT_TRUE(AreFinite(numbers));
  EXPECT_TRUE(AreFinite({}));
  for (size_t i = 0; i < numbers.size(); ++i) {
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()}) {
      const float kept = numbers[i];
      numbers[i] = value;
      EXPECT_FALSE(AreFinite(numbers)) << i;
      numbers[i] = kept;
    }
  }
}

}  // namespace
}  // namespace daumier::runtime
