#include "datasets/gestures/gesture.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

TEST(Gesture, HasANameOfItsOwn) {
  std::set<std::string> names;
  for (int i = 0; i <= kNumGestures; ++i) names.insert(NameOf(static_cast<Gesture>(i)));
  EXPECT_EQ(names.size(), size_t{kNumGestures} + 1);
  EXPECT_EQ(NameOf(Gesture::kDownRoll3), "down_roll_3");
  EXPECT_EQ(NameOf(Gesture::kNone), "none");
}

}  // namespace
}  // namespace daumier::datasets
