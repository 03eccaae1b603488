#include "rig/expression_map.h"

#include "faces/face_model_file.h"
#include "rig/arkit_names.h"
#include "rig/expression_targets.h"
#include "tests/rig/random_targets.h"
#include "tests/rig/small_expression_map.h"
#include "tests/support/expect_error.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::rig {
namespace {

using testing::SmallExpressionMap;

Eigen::Index TargetAt(const char* name) {
  return *FindArkitName(name);
}

class ExpressionMaps : public ::testing::Test {
 protected:
  static const faces::FaceModel& Model() {
    static const faces::FaceModel model = faces::ReadFaceModel(testing::SourceRoot() / "weights/face-ict");
    return model;
  }
  static const MorphTargets& Targets() {
    static const MorphTargets targets = ExpressionTargets(Model()).On(Model().face_template.neutral);
    return targets;
  }
  /// Expressions that are these weights of the targets.
  static ModelExpressions Mixtures(const Eigen::MatrixXd& weights, CoefficientKind kind) {
    ModelExpressions model{Model().face_template, {}, (Targets().offsets.cast<double>() * weights).cast<float>()};
    for (int e = 0; e < weights.cols(); ++e) model.names.push_back(fmt::format("mixture_{}", e));
    model.kind = kind;
    return model;
  }
};

TEST_F(ExpressionMaps, OfTheTargetsThemselvesAreTheIdentity) {
  ModelExpressions model = Mixtures(Eigen::MatrixXd::Identity(kNumArkitNames, kNumArkitNames), CoefficientKind::kBlend);
  model.has_gaze = true;
  const ExpressionMap map = MapExpressions(model, Targets());
  for (int e = 0; e < kNumArkitNames; ++e) {
    const std::string_view name = ArkitNames()[size_t(e)];
    if (name == "tongueOut" || name == "mouthClose") continue;  // These are no expression alone.
    EXPECT_NEAR(map.positive(e, e), 1, 1e-4) << name;
    EXPECT_NEAR(map.positive.row(e).sum(), 1, 1e-3) << name;
    EXPECT_LT(map.mapped[size_t(e)].error.greatest_cm, 1e-4) << name;
  }
}

/// Its shapes are those of the targets but where lids and lips are made to meet.
TEST_F(ExpressionMaps, OfTheModelsOwnExpressionsAreNearlyTheIdentity) {
  const ExpressionMap map = MapExpressions(ExpressionsOf(Model()), Targets());
  int num_named = 0;
  for (int e = 0; e < map.num_expressions(); ++e) {
    const std::string& name = map.expressions[size_t(e)];
    const auto target = FindArkitName(name);
    if (!target || name == "mouthClose") continue;
    ++num_named;
    EXPECT_NEAR(map.positive(e, *target), 1, 0.1) << name;
    EXPECT_GT(map.mapped[size_t(e)].explained().value(), 0.8) << name;
  }
  EXPECT_EQ(num_named, 48);
  EXPECT_EQ(map.negative.rows(), 0);
}

TEST_F(ExpressionMaps, RecoverMixturesOfTargets) {
  Rng rng(1);
  Eigen::MatrixXd weights(kNumArkitNames, 4);
  for (int e = 0; e < 4; ++e) weights.col(e) = testing::RandomWeights(rng);
  ModelExpressions model = Mixtures(weights, CoefficientKind::kBlend);
  model.has_gaze = true;
  const ExpressionMap map = MapExpressions(model, Targets());
  EXPECT_LT((map.positive.cast<double>() - weights.transpose()).cwiseAbs().maxCoeff(), 1e-3);
  for (const MappedExpression& mapped : map.mapped) {
    EXPECT_LT(mapped.error.greatest_cm, 1e-3);
    EXPECT_GT(mapped.explained().value(), 0.9999);
  }
}

TEST_F(ExpressionMaps, OfSignedModesHaveTwoEnds) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(kNumArkitNames, 3);
  weights(TargetAt("browDownRight"), 0) = 0.4;
  weights(TargetAt("mouthSmileLeft"), 0) = -0.3;
  weights(TargetAt("browInnerUp"), 1) = 0.2;
  ModelExpressions model = Mixtures(weights, CoefficientKind::kSigned);
  model.constant = 1;
  const ExpressionMap map = MapExpressions(model, Targets());
  EXPECT_NEAR(map.positive(0, TargetAt("browDownRight")), 0.4, 0.1);
  EXPECT_NEAR(map.negative(0, TargetAt("mouthSmileLeft")), 0.3, 0.1);
  EXPECT_NEAR(map.positive(1, TargetAt("browInnerUp")), 0.2, 1e-4);
  EXPECT_TRUE(map.negative.row(1).isZero()) << "constant";
  EXPECT_TRUE(map.positive.row(2).isZero());
  ASSERT_EQ(map.mapped.size(), 6u);
  EXPECT_EQ(map.mapped[3].name, "mixture_0");
  EXPECT_TRUE(map.mapped[3].is_negative);
  EXPECT_FALSE(map.mapped[2].explained()) << "it does not move the face";
  const double explained = map.mapped[0].explained().value();
  EXPECT_NEAR(explained, 1 - std::pow(map.mapped[0].error.rms_cm / map.mapped[0].no_motion.rms_cm, 2), 1e-12);
  EXPECT_GT(explained, 0.5);
}

TEST_F(ExpressionMaps, TurnNoEyesOfAModelWithoutGaze) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(kNumArkitNames, 1);
  weights(TargetAt("eyeLookDownLeft"), 0) = 0.8;
  weights(TargetAt("tongueOut"), 0) = 0.3;
  ModelExpressions model = Mixtures(weights, CoefficientKind::kBlend);
  EXPECT_EQ(MapExpressions(model, Targets()).positive(0, TargetAt("eyeLookDownLeft")), 0);
  model.has_gaze = true;
  EXPECT_NEAR(MapExpressions(model, Targets()).positive(0, TargetAt("eyeLookDownLeft")), 0.8, 0.05);
  EXPECT_EQ(MapExpressions(model, Targets()).positive(0, TargetAt("tongueOut")), 0);
}

TEST(WeightsOfCoefficients, ByHand) {
  const Eigen::MatrixXf weights =
      WeightsOf(SmallExpressionMap(), (Eigen::MatrixXf(3, 3) << 1, 0, 1, /**/ -2, 0.5f, 1, /**/ 10, -1, 1).finished());
  EXPECT_FLOAT_EQ(weights(0, TargetAt("jawOpen")), 0.625f);
  EXPECT_EQ(weights.row(0).sum(), 0.625f);
  EXPECT_FLOAT_EQ(weights(1, TargetAt("jawOpen")), 0.125f);
  EXPECT_FLOAT_EQ(weights(1, TargetAt("mouthPucker")), 0.5f);
  EXPECT_FLOAT_EQ(weights(1, TargetAt("eyeBlinkLeft")), 0.5f);
  EXPECT_EQ(weights(2, TargetAt("jawOpen")), 1) << "clamped";
  EXPECT_EQ(weights(2, TargetAt("eyeBlinkLeft")), 0) << "the negative end of b is nothing";
}

TEST(WeightsOfCoefficients, AreWithinTheLimitsOfTargets) {
  const Eigen::MatrixXf weights = WeightsOf(SmallExpressionMap(), (Eigen::MatrixXf(1, 3) << 0, 1, 0).finished());
  EXPECT_FLOAT_EQ(weights(0, TargetAt("eyeSquintLeft")), 1);
  EXPECT_FLOAT_EQ(weights(0, TargetAt("eyeBlinkLeft")), 0.75f) << "1 - 0.25 eyeSquintLeft";
}

TEST(WeightsOfCoefficients, OfAMapWithKeptStrengthAreTimesTheGain) {
  const ExpressionMap map = SmallExpressionMap(), kept = WithKeptStrength(map);
  EXPECT_FLOAT_EQ(kept.positive(0, TargetAt("jawOpen")), 1.5f * 0.5f);
  EXPECT_EQ(kept.positive.bottomRows(2), map.positive.bottomRows(2));
  EXPECT_EQ(kept.negative, map.negative);
}

/// A target that moves a wider region than the expression: least squares show less of it than there is at its centre.
TEST_F(ExpressionMaps, OfNarrowExpressionsHaveAGain) {
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(kNumArkitNames, 2);
  weights(TargetAt("browInnerUp"), 0) = weights(TargetAt("browInnerUp"), 1) = 0.5;
  ModelExpressions model = Mixtures(weights, CoefficientKind::kBlend);
  for (Eigen::Index v = 0; v < model.shapes.rows() / 3; ++v)
    if (model.shapes.col(1).segment<3>(3 * v).norm() < 0.15f) model.shapes.col(1).segment<3>(3 * v).setZero();
  const ExpressionMap map = MapExpressions(model, Targets());
  EXPECT_NEAR(map.mapped[0].gain, 1, 1e-4) << "shown as it is";
  EXPECT_GT(map.mapped[1].gain, 1.02);
  EXPECT_LT(map.mapped[1].gain, kMostGain);
  EXPECT_NEAR(map.mapped[1].gain * map.positive(1, TargetAt("browInnerUp")), 0.5, 0.1);
}

TEST(WeightsOfCoefficients, NeedFiniteCoefficientsOfEveryExpression) {
  testing::ExpectError([] { WeightsOf(SmallExpressionMap(), Eigen::MatrixXf::Zero(1, 2)); },
                       "frames have 2 coefficients");
  testing::ExpectError([] { WeightsOf(SmallExpressionMap(), Eigen::MatrixXf::Constant(1, 3, std::nanf(""))); },
                       "not finite");
}

}  // namespace
}  // namespace daumier::rig
