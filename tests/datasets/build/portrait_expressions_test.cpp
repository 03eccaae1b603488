#include "datasets/build/portrait_expressions.h"

#include "tests/support/expect_error.h"
#include "tests/support/synthetic_database.h"
#include "tests/support/temp_dir.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

/// right blink, left blink, jaw, smile, brows, another one, and one that passes lips through each other.
std::vector<ExpressionEffect> PlainEffects() {
  std::vector<ExpressionEffect> effects(7);
  effects[0].closes[0] = 1, effects[0].mirrored = 1;
  effects[1].closes[1] = 1, effects[1].mirrored = 0;
  effects[2].opens = 0.5;
  effects[3].smiles = 0.2;
  effects[4].brows = 0.1;
  effects[6].lips_cross = 0.2;
  return effects;
}

TEST(ExpressionDrawer, DrawsWinksClosedEyesOpenMouthsAndNeutralFaces) {
  const ExpressionDrawer drawer(PlainEffects());
  constexpr int kNumDraws = 2000;
  int both = 0, wink_right = 0, wink_left = 0, open = 0, smile = 0, grin = 0, neutral = 0;
  for (uint64_t seed = 0; seed < kNumDraws; ++seed) {
    Rng rng(seed);
    const Eigen::VectorXf weights = drawer.Draw(rng);
    ASSERT_EQ(weights.size(), 7);
    EXPECT_GE(weights.minCoeff(), 0);
    EXPECT_LE(weights.maxCoeff(), 1);
    EXPECT_EQ(weights[6], 0);
    both += weights[0] > 0.85f && weights[1] > 0.85f;
    wink_right += weights[0] > 0.85f && weights[1] == 0;
    wink_left += weights[1] > 0.85f && weights[0] == 0;
    open += weights[2] > 0.1f;
    smile += weights[3] > 0.2f;
    grin += weights[3] > 0.5f && weights[2] > 0.09f;
    neutral += weights.isZero(0);
  }
  EXPECT_NEAR(double(both) / kNumDraws, 0.072, 0.02);
  EXPECT_GT(wink_right, 50);
  EXPECT_GT(wink_left, 50);
  EXPECT_GT(open, 500);
  EXPECT_GT(smile, 500);
  EXPECT_GT(grin, 400);
  EXPECT_NEAR(double(neutral) / kNumDraws, 0.13, 0.05);
}

class PortraitExpressionsTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new testing::TempDir;
    testing::BuildSyntheticFaces(*folder_ / "faces", 2);
  }
  static void TearDownTestSuite() { delete folder_; }
  static inline testing::TempDir* folder_ = nullptr;
};

TEST_F(PortraitExpressionsTest, ShapesAreTransferredToEachFace) {
  const faces::FaceDatabase database(*folder_ / "faces");
  const faces::FaceModel model = testing::SyntheticModel();
  const PortraitExpressions expressions(database, model);
  EXPECT_EQ(expressions.names(), model.expression_shape_names);
  std::vector<faces::Expression> single;
  for (int e = 0; e < 7; ++e) single.push_back({"", Eigen::VectorXf::Unit(7, e)});
  const geometry::Points neutral = database.points(database.index({1, 1, 0}));
  const Eigen::MatrixXf offsets = faces::ExpressionTransfer(model, single).Offsets(neutral);
  Eigen::VectorXf weights = Eigen::VectorXf::Zero(7);
  weights[0] = 0.6f, weights[3] = 1, weights[5] = 0.25f;
  const geometry::Points face = expressions.FaceOf(1, 1)(weights);
  const Eigen::VectorXf offset = offsets * weights;
  for (Eigen::Index k = 0; k < face.size(); ++k) EXPECT_NEAR(face.data()[k], neutral.data()[k] + offset[k], 1e-4);
  EXPECT_EQ(expressions.FaceOf(1, 1)(Eigen::VectorXf::Zero(7)), neutral);
}

TEST_F(PortraitExpressionsTest, WithoutAModelTheDatabasesOwnAreMixed) {
  const faces::FaceDatabase database(*folder_ / "faces");
  const PortraitExpressions expressions(database, std::nullopt);
  EXPECT_EQ(expressions.names(), (std::vector<std::string>{"jaw_open", "smile", "laugh"}));
  const geometry::Points face = expressions.FaceOf(1, 0)(Eigen::VectorXf::Unit(3, 1));
  EXPECT_LT((face - database.points(database.index({1, 0, 2}))).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(PortraitExpressionsTest, AModelOfAnotherTopologyIsRefused) {
  const faces::FaceDatabase database(*folder_ / "faces");
  faces::FaceModel model = testing::SyntheticModel();
  model.face_template.triangles.row(0).reverseInPlace();
  testing::ExpectError([&] { PortraitExpressions(database, model); }, "other triangles than the faces' template");
}

}  // namespace
}  // namespace daumier::datasets
