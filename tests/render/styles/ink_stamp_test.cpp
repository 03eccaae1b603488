#include "render/styles/ink_stamp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

TEST(StampInk, HasTheCoverageWorkedOutByHand) {
  Plane ink(5, 5);
  StampInk(ink, 2.5f, 2.5f, 0.75f);
  EXPECT_EQ(ink.at(2, 2), 1);
  EXPECT_NEAR(ink.at(2, 3), 0.25f, 1e-6) << "a pixel away: 0.75 + 0.5 - 1";
  EXPECT_EQ(ink.at(2, 4), 0);
  StampInk(ink, 2.5f, 2.5f, 0.5f);
  EXPECT_NEAR(ink.at(2, 3), 0.25f, 1e-6) << "stamps do not add up";
  StampInk(ink, -30, 90, 3);
  StampInk(ink, 0.5f, 0.5f, -0.6f);
  EXPECT_EQ(ink.at(0, 0), 0);
}

}  // namespace
}  // namespace daumier::render
