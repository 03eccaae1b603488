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
