#include "faces/controls/composition.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::faces {
namespace {

TEST(Composition, TwoTogetherDifferFromTheSumOfBoth) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceControls controls(face);
  const auto pairs = MeasureComposition(controls, face, 2.0);
  EXPECT_EQ(pairs.size(), 60u * 59 / 2);
  EXPECT_GT(pairs.front().max_mm, 2);
  for (size_t i = 1; i < pairs.size(); ++i) EXPECT_GE(pairs[i - 1].max_mm, pairs[i].max_mm);
  // Two motions along axes that carry each other by no pivot add up.
  const auto plain = std::find_if(pairs.begin(), pairs.end(), [](const PairComposition& pair) {
    return pair.first == "forehead_height" && pair.second == "skull_depth";
  });
  ASSERT_NE(plain, pairs.end());
  EXPECT_LT(plain->max_mm, 1e-9);
}

}  // namespace
}  // namespace daumier::faces
