#include "core/config_differences.h"

#include <gtest/gtest.h>

namespace daumier {
namespace {

const Json kThere = {{"seed", 1}, {"optimiser", {{"learning_rate", 0.001}, {"beta1", 0.9}}}};

TEST(ConfigDifferences, NamesDottedKeysAndBothValues) {
  Json now = kThere;
  now["optimiser"]["learning_rate"] = 0.01;
  now["optimiser"].erase("beta1");
  now["epochs"] = 3;
  EXPECT_EQ(
      ConfigDifferences(kThere, now),
      (std::vector<std::string>{"epochs is missing there and 3 now", "optimiser.beta1 is 0.9 there and missing now",
                                "optimiser.learning_rate is 0.001 there and 0.01 now"}));
  EXPECT_TRUE(ConfigDifferences(kThere, kThere).empty());
}

TEST(ConfigDifferences, AKeyThatIsMissingThereCountsAsItsDefault) {
  Json now = kThere;
  now["accumulate"] = 1;
  now["optimiser"]["beta2"] = 0.99;
  now["stages"] = {{"rate", 2}};
  const Json defaults = {{"accumulate", 1}, {"optimiser", {{"beta2", 0.999}}}, {"stages", {{"rate", 1}}}, {"data", ""}};
  EXPECT_EQ(
      ConfigDifferences(kThere, now, defaults),
      (std::vector<std::string>{"optimiser.beta2 is 0.999 there and 0.99 now", "stages.rate is 1 there and 2 now"}));
}

TEST(ConfigDifferences, EqualNumbersOfOtherTypesDoNotDiffer) {
  EXPECT_TRUE(ConfigDifferences({{"rate", 1}}, {{"rate", 1.0}}).empty());
}

}  // namespace
}  // namespace daumier
