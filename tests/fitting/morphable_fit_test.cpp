#include "fitting/morphable_fit.h"

#include "core/random.h"
#include "faces/curve_encoder.h"
#include "tests/fitting/projected_face.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

class MorphableFitTest : public ::testing::Test {
 protected:
  Eigen::VectorXf FaceOf(const MorphableFit& fit) const { return faces::Reconstruct(seen_.model, fit.u, fit.v); }

  ProjectedFace seen_;
  const ProjectedModel projected_ = ProjectModel(seen_.curves, seen_.model);
};

TEST_F(MorphableFitTest, TheFaceComesBackFromItsExactPoints) {
  for (const bool prior : {false, true}) {
    for (const int identity : {1, 6, 13}) {
      const Eigen::VectorXf truth = seen_.Face(identity, 4), mean = seen_.Face(0, 0);
      const auto fit = FitMorphable(projected_, seen_.Points(truth), seen_.Ones(),
                                    {.prior = prior, .deviation_px = 1e-3, .iterations = 300});
      EXPECT_LT(MeanDistance(FaceOf(fit), truth), 2e-3) << "cm; the first face is " << MeanDistance(mean, truth);
      EXPECT_LT(fit.rms_px, 2e-3);
      EXPECT_GT(fit.iterations, 1);
    }
  }
}

TEST_F(MorphableFitTest, AgreesWithAlternatingLeastSquares) {
  Rng rng = Stream(4, "points");
  auto points = seen_.Points(seen_.Face(2, 5));
  for (float& coordinate : points) coordinate += float(rng.Normal());
  const auto fit = FitMorphable(projected_, points, seen_.Ones(), {.deviation_px = 2, .iterations = 300});
  for (size_t i = 0; i < points.size(); ++i) points[i] -= projected_.constant[Eigen::Index(i)];
  const faces::CurveEncoder encoder(projected_.model, {.deviation_px = 2, .rounds = 1000});
  const auto code = encoder.Encode(points, seen_.Ones());
  EXPECT_LT((fit.u - code.u).norm(), 2e-3 * code.u.norm());
  EXPECT_LT((fit.v - code.v).norm(), 2e-3 * code.v.norm());
}

TEST_F(MorphableFitTest, DerivativesAreCentralDifferences) {
  auto weights = seen_.Ones();
  weights[3] = 0, weights[5] = 0.25f;
  const KeyPointResiduals residuals(projected_, seen_.Points(seen_.Face(1, 1)), weights, 0.5);
  ASSERT_EQ(residuals.num_residuals(), 2 * seen_.curves.num_points() - 2);
  Rng rng = Stream(9, "coefficients");
  Eigen::VectorXd u = Eigen::VectorXd::NullaryExpr(4, [&] { return rng.Normal(); });
  Eigen::VectorXd v = Eigen::VectorXd::NullaryExpr(3, [&] { return rng.Normal(); });
  const auto value = residuals.At(u, v);
  constexpr double kStep = 1e-4;
  const auto worst = [&](Eigen::VectorXd& x, const KeyPointResiduals::Rows& analytic) {
    double difference = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double kept = x[i];
      x[i] = kept + kStep;
      const Eigen::VectorXd after = residuals.At(u, v).residuals;
      x[i] = kept - kStep;
      const Eigen::VectorXd before = residuals.At(u, v).residuals;
      x[i] = kept;
      difference = std::max(difference, ((after - before) / (2 * kStep) - analytic.col(i)).cwiseAbs().maxCoeff());
    }
    return difference;
  };
  EXPECT_LT(worst(u, value.by_u), 1e-6);
  EXPECT_LT(worst(v, value.by_v), 1e-6);
}

TEST_F(MorphableFitTest, PointsOfWeightZeroAreIgnored) {
  auto points = seen_.Points(seen_.Face(3, 2));
  auto weights = seen_.Ones();
  weights[0] = weights[17] = 0;
  const auto before = FitMorphable(projected_, points, weights);
  points[0] = 1e4f, points[34] = -1e4f;
  const auto after = FitMorphable(projected_, points, weights);
  EXPECT_EQ(before.u, after.u);
  EXPECT_EQ(before.v, after.v);
}

TEST_F(MorphableFitTest, ThePriorKeepsUndeterminedCoefficientsNearTheTrainingFaces) {
  auto points = seen_.Points(seen_.Face(3, 2));
  std::vector<float> weights(size_t(seen_.curves.num_points()), 0.0f);
  weights[2] = 1;
  points[4] += 5;
  const auto prior = faces::PriorOf(seen_.model);
  const auto away = [&](const MorphableFit& fit) {
    return ((fit.u - prior.u_mean).array() / prior.u_deviation.array()).matrix().norm();
  };
  EXPECT_LT(away(FitMorphable(projected_, points, weights, {.deviation_px = 50})), 0.5);
  EXPECT_GT(away(FitMorphable(projected_, points, weights, {.prior = false})), 0.5);
}

TEST_F(MorphableFitTest, WithoutPriorTheExpressionIsAsLongAsTheMean) {
  const auto fit = FitMorphable(projected_, seen_.Points(seen_.Face(8, 7)), seen_.Ones(), {.prior = false});
  EXPECT_NEAR(fit.v.norm(), faces::PriorOf(seen_.model).v_mean.norm(), 1e-5);
}

TEST_F(MorphableFitTest, RefusesWhatDoesNotFit) {
  const auto points = seen_.Points(seen_.Face(0, 0));
  auto weights = seen_.Ones();
  testing::ExpectError([&] { FitMorphable(projected_, std::span(points).first(6), weights); }, "6 coordinates");
  testing::ExpectError([&] { FitMorphable(projected_, points, std::span(weights).first(2)); }, "2 weights");
  weights[1] = -1;
  testing::ExpectError([&] { FitMorphable(projected_, points, weights); }, "key point 1 has the weight -1");
  weights.assign(weights.size(), 0);
  testing::ExpectError([&] { FitMorphable(projected_, points, weights); }, "counts");
}

}  // namespace
}  // namespace daumier::fitting
