#include "systems/portrait/landmark_split.h"

#include "tests/support/drawn_portraits.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::portrait {
namespace {

TEST(SplitSamples, KeepsPersonsTogether) {
  const testing::DrawnPortraits source(40);
  const datasets::Split split = SplitSamples(source, {.validation = 0.1, .test = 0.2}, 3);
  EXPECT_EQ(split.test.size(), 8u);
  EXPECT_EQ(split.validation.size(), 4u);
  EXPECT_EQ(split.train.size(), 28u);
  std::set<int> persons;
  for (const int i : split.test) persons.insert(source.person(i));
  for (const int i : split.train) EXPECT_FALSE(persons.contains(source.person(i)));
  testing::ExpectError([] { SplitSamples(testing::DrawnPortraits(2), {}, 1); }, "too few");
}

}  // namespace
}  // namespace daumier::portrait
