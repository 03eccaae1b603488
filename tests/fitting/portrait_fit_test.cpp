#include "fitting/portrait_fit.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/synthetic_model.h"

namespace daumier::fitting {
namespace {

faces::MorphableModel FittedModel() {
  const faces::FaceModel source = testing::SyntheticModel();
  const int num_vertices = source.face_template.num_vertices();
  return faces::ModelOfShapes(
      source, {Eigen::MatrixXf::Constant(num_vertices, 3, 0.6F), Eigen::MatrixXf::Zero(3 * num_vertices, 1)});
}

PortraitPose SomePose(double yaw) {
  PortraitPose pose;
  pose << 0.1, yaw, -0.08, 1.2, -0.7, -30;
  return pose;
}

PicturePoints Seen(const LandmarkModel& model, const PortraitPose& pose, const Eigen::VectorXd& identity,
                   const Eigen::VectorXd& expression) {
  return Projected(Posed(model.Landmarks(identity, expression), pose));
}

TEST(LandmarkModel, DerivativesEqualCentralDifferences) {
  const LandmarkModel model(FittedModel());
  Rng rng(4);
  Eigen::VectorXd identity(model.num_identity()), expression(model.num_expression());
  for (double& x : identity) x = rng.Normal();
  for (double& x : expression) x = rng.Uniform();
  const PortraitPose pose = SomePose(0.4);
  const LandmarkModel::Value value = model.At(pose, identity, expression);
  const PicturePoints pixels = Seen(model, pose, identity, expression);
  EXPECT_LT((value.pixels - Eigen::Map<const Eigen::VectorXd>(pixels.data(), 136)).norm(), 1e-9);
  constexpr double kStep = 1e-5;
  const auto error = [&](auto vary, const LandmarkModel::Rows& derivative) {
    double worst = 0;
    for (Eigen::Index k = 0; k < derivative.cols(); ++k) {
      const Eigen::VectorXd numeric = (vary(k, kStep) - vary(k, -kStep)) / (2 * kStep);
      worst = std::max(worst, (numeric - derivative.col(k)).cwiseAbs().maxCoeff());
    }
    return worst;
  };
  EXPECT_LT(error(
                [&](Eigen::Index k, double by) {
                  PortraitPose moved = pose;
                  moved[k] += by;
                  return model.At(moved, identity, expression).pixels;
                },
                value.by_pose),
            1e-5);
  EXPECT_LT(error(
                [&](Eigen::Index k, double by) {
                  Eigen::VectorXd moved = identity;
                  moved[k] += by;
                  return model.At(pose, moved, expression).pixels;
                },
                value.by_identity),
            1e-5);
  EXPECT_LT(error(
                [&](Eigen::Index k, double by) {
                  Eigen::VectorXd moved = expression;
                  moved[k] += by;
                  return model.At(pose, identity, moved).pixels;
                },
                value.by_expression),
            1e-5);
}

TEST(FitPortrait, FindsThePoseOfTheMeanFaceAlsoFromTheSide) {
  const LandmarkModel model(FittedModel());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.num_identity()),
                        still = Eigen::VectorXd::Zero(model.num_expression());
  for (const double yaw : {-1.0, -0.3, 0.0, 0.5, 1.0}) {
    const PortraitPose pose = SomePose(yaw);
    const PortraitFit fit = FitPortrait(model, Seen(model, pose, none, still), Eigen::VectorXd::Ones(68),
                                        {.freedom = PortraitFreedom::kPose});
    EXPECT_LT(AngleBetween(fit.pose(), pose), 0.05) << yaw;
    EXPECT_LT((fit.pose() - pose).tail<3>().norm(), 0.1) << yaw;
    EXPECT_LT(fit.rms_px, 0.02);
  }
}

TEST(FitPortrait, FindsAFaceOfTheModel) {
  const LandmarkModel model(FittedModel());
  Eigen::VectorXd identity = Eigen::VectorXd::Zero(model.num_identity()),
                  expression = Eigen::VectorXd::Zero(model.num_expression());
  identity[0] = 1, identity[3] = -1, expression[0] = 0.7, expression[1] = 0.6;
  const PicturePoints landmarks = Seen(model, SomePose(0.3), identity, expression);
  const PortraitFit pose_alone =
      FitPortrait(model, landmarks, Eigen::VectorXd::Ones(68), {.freedom = PortraitFreedom::kPose});
  const PortraitFit fit = FitPortrait(model, landmarks, Eigen::VectorXd::Ones(68), {.deviation_px = 0.1});
  EXPECT_LT(fit.rms_px, 0.2);
  EXPECT_GT(pose_alone.rms_px, 5 * fit.rms_px);
  EXPECT_NEAR(fit.coefficients[faces::kExpressionSlot.first], 0.7, 0.1);
  EXPECT_GE(fit.coefficients.segment(faces::kExpressionSlot.first, 64).minCoeff(), 0);
  EXPECT_LE(fit.coefficients.segment(faces::kExpressionSlot.first, 64).maxCoeff(), 1);
}

TEST(FitPortrait, IgnoresLandmarksOfWeightZero) {
  const LandmarkModel model(FittedModel());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(model.num_identity()),
                        still = Eigen::VectorXd::Zero(model.num_expression());
  const PortraitPose pose = SomePose(0.2);
  PicturePoints landmarks = Seen(model, pose, none, still);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(68);
  for (int n = 0; n < 8; ++n) {
    landmarks.row(n).setConstant(std::nan(""));
    weights[n] = 0;
  }
  EXPECT_LT(AngleBetween(FitPortrait(model, landmarks, weights, {.freedom = PortraitFreedom::kPose}).pose(), pose),
            0.05);
}

/// A face of the model whose landmarks are seen, and coefficients of another one in another pose.
struct AdjustmentProblem {
  LandmarkModel model{FittedModel()};
  PicturePoints landmarks{68, 2};
  Eigen::VectorXf truth = Eigen::VectorXf::Zero(faces::kNumCoefficients), start = truth;

  AdjustmentProblem() {
    truth[0] = 0.8F, truth[4] = -0.6F, truth[80] = 0.5F;
    truth.tail<6>() = SomePose(0.2).cast<float>();
    start = truth;
    start[144] = 3;  // Albedo.
    landmarks = Seen(model, SomePose(0.2), truth.head(model.num_identity()).cast<double>(),
                     truth.segment(80, model.num_expression()).cast<double>());
  }
};

TEST(AdjustPortrait, FindsWhatIsFreeAndLeavesTheRest) {
  const AdjustmentProblem problem;
  const PortraitFitOptions options{.deviation_px = 0.01};
  const auto adjust = [&](PortraitAdjustment adjustment, const Eigen::VectorXf& start) {
    return AdjustPortrait(problem.model, start, problem.landmarks, Eigen::VectorXd::Ones(68), adjustment, options);
  };
  Eigen::VectorXf start = problem.start;
  start[233 + 3] += 0.5F, start[234] += 0.2F;
  const PortraitFit by_pose = adjust(PortraitAdjustment::kPose, start);
  EXPECT_LT(by_pose.rms_px, 0.02);
  EXPECT_EQ(by_pose.coefficients.head(233), problem.start.head(233));

  start = problem.start;
  start[80] = 0.1F, start[82] = 0.6F;
  const PortraitFit by_expression = adjust(PortraitAdjustment::kExpression, start);
  EXPECT_LT(by_expression.rms_px, 0.02);
  EXPECT_NEAR(by_expression.coefficients[80], 0.5, 0.05);
  EXPECT_EQ(by_expression.coefficients.head(80), problem.start.head(80));
  EXPECT_EQ(by_expression.coefficients.tail(95), problem.start.tail(95));

  start[0] = 0, start[4] = 0;
  EXPECT_GT(adjust(PortraitAdjustment::kExpression, start).rms_px, 0.3);
  const PortraitFit by_both = adjust(PortraitAdjustment::kIdentityAndExpression, start);
  EXPECT_LT(by_both.rms_px, 0.05);
  EXPECT_EQ(by_both.coefficients.tail(95), problem.start.tail(95));
}

TEST(AdjustPortrait, PriorsMayBeAboutTheGivenFace) {
  const AdjustmentProblem problem;
  const auto adjust = [&](bool about_start) {
    return AdjustPortrait(problem.model, problem.truth, problem.landmarks, Eigen::VectorXd::Ones(68),
                          PortraitAdjustment::kAll, {.deviation_px = 10, .about_start = about_start})
        .coefficients;
  };
  EXPECT_LT((adjust(true) - problem.truth).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_GT((adjust(false) - problem.truth).cwiseAbs().maxCoeff(), 0.05);
}

TEST(AdjustPortrait, RefusesOtherCoefficients) {
  const AdjustmentProblem problem;
  testing::ExpectError(
      [&] {
        AdjustPortrait(problem.model, problem.start.head(6), problem.landmarks, Eigen::VectorXd::Ones(68),
                       PortraitAdjustment::kPose);
      },
      "6 coefficients of a portrait, expected 239");
}

TEST(FitPortrait, RefusesWhatIsNoSetOfLandmarks) {
  const LandmarkModel model(FittedModel());
  PicturePoints landmarks = PicturePoints::Random(68, 2);
  using testing::ExpectError;
  ExpectError([&] { FitPortrait(model, landmarks.topRows(60), Eigen::VectorXd::Ones(60)); }, "expected 68");
  ExpectError([&] { FitPortrait(model, landmarks, -Eigen::VectorXd::Ones(68)); }, "landmark 0 has the weight -1");
  Eigen::VectorXd few = Eigen::VectorXd::Zero(68);
  few.head(3).setOnes();
  ExpectError([&] { FitPortrait(model, landmarks, few); }, "3 landmarks count");
}

}  // namespace
}  // namespace daumier::fitting
