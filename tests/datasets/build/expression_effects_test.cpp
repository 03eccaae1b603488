#include "datasets/build/expression_effects.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

// jaw_open, smile_left, smile_right, blink_left, blink_right, brow_raise, pucker.
class ExpressionEffectsTest : public ::testing::Test {
 protected:
  const faces::FaceModel model_ = testing::SyntheticModel();
  const std::vector<ExpressionEffect> effects_ = MeasureEffects(model_.face_template, model_.expression_shapes);
};

TEST_F(ExpressionEffectsTest, EachShapeDoesWhatItsNameSays) {
  ASSERT_EQ(effects_.size(), 7u);
  EXPECT_GT(effects_[0].opens, 0.1);
  EXPECT_GT(effects_[1].smiles, 0.05);
  EXPECT_GT(effects_[3].closes[1], 0.2) << "the left eye";
  EXPECT_LT(effects_[3].closes[0], 0.01) << "the right eye";
  EXPECT_GT(effects_[4].closes[0], 0.2);
  EXPECT_GT(effects_[5].brows, 0.02);
  for (const size_t e : {1u, 3u, 5u}) EXPECT_NEAR(effects_[e].opens, 0, 0.05) << e;
}

TEST_F(ExpressionEffectsTest, ShapesOfTheTwoSidesArePairs) {
  EXPECT_EQ(effects_[1].mirrored, 2);
  EXPECT_EQ(effects_[2].mirrored, 1);
  EXPECT_EQ(effects_[3].mirrored, 4);
  for (const size_t e : {0u, 5u, 6u}) EXPECT_FALSE(effects_[e].mirrored) << e;
}

TEST_F(ExpressionEffectsTest, ShapesOfAnotherTopologyAreRefused) {
  testing::ExpectError([&] { MeasureEffects(model_.face_template, Eigen::MatrixXf::Zero(3, 2)); },
                       "expression shapes of 3 rows");
}

}  // namespace
}  // namespace daumier::datasets
