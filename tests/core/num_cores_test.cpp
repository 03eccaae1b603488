#include "core/num_cores.h"

#include <gtest/gtest.h>
#include <sched.h>

namespace daumier {
namespace {

TEST(NumCores, QuotaOfAControlGroupIsRoundedUp) {
  EXPECT_EQ(CoresOfQuota("200000 100000\n"), 2);
  EXPECT_EQ(CoresOfQuota("150000 100000"), 2);
  EXPECT_EQ(CoresOfQuota("50000 100000"), 1);
}

TEST(NumCores, NoQuotaIsNoLimit) {
  EXPECT_EQ(CoresOfQuota("max 100000\n"), 0);
  EXPECT_EQ(CoresOfQuota("-1\n 100000\n"), 0);
  EXPECT_EQ(CoresOfQuota(" "), 0);
  EXPECT_EQ(CoresOfQuota("100000"), 0);
  EXPECT_EQ(CoresOfQuota("100000 0"), 0);
}

TEST(NumCores, RespectsTheAffinity) {
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof(before), &before), 0);
  EXPECT_GE(NumCores(), 1);
  EXPECT_LE(NumCores(), CPU_COUNT(&before));
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
  EXPECT_EQ(NumCores(), 1);
  ASSERT_EQ(sched_setaffinity(0, sizeof(before), &before), 0);
}

}  // namespace
}  // namespace daumier
