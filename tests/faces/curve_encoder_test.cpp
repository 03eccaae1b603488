#include "faces/curve_encoder.h"

#include "tests/support/expect_error.h"
#include "tests/support/random_bilinear.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

/// Points of a random model: 60 of them, u of 4 and v of 3 numbers; identity and expression factors around (2, 0, ...).
class CurveEncoderTest : public ::testing::Test {
 protected:
  CurveEncoderTest() : model_(testing::RandomBilinear(40, 4, 3, 11)) {
    model_.identity_factors *= 0.3f;
    model_.expression_factors *= 0.3f;
    model_.identity_factors.col(0).array() += 2;
    model_.expression_factors.col(0).array() += 2;
  }

  Eigen::VectorXf PointsOf(int identity, int expression) const {
    return Reconstruct(model_, model_.identity_factors.row(identity), model_.expression_factors.row(expression));
  }
  static std::span<const float> View(const Eigen::VectorXf& vector) { return {vector.data(), size_t(vector.size())}; }

  BilinearModel model_;
  const std::vector<float> ones_ = std::vector<float>(60, 1.0f);
};

TEST_F(CurveEncoderTest, RebuildsPointsOfTheModel) {
  const CurveEncoder encoder(model_, {.deviation_px = 0.001, .rounds = 30});
  ASSERT_EQ(encoder.num_points(), 60);
  for (int identity = 0; identity < 5; ++identity) {
    const Eigen::VectorXf points = PointsOf(identity, identity);
    const CurveCode code = encoder.Encode(View(points), ones_);
    EXPECT_LT((code.points - points).norm(), 1e-2 * points.norm()) << identity;
    EXPECT_LT((Reconstruct(model_, code.u, code.v) - code.points).norm(), 1e-5 * points.norm());
    EXPECT_EQ(code.numbers().size(), 7);
    EXPECT_EQ(code.numbers()[4], code.v[0]);
  }
}

TEST_F(CurveEncoderTest, PointsOfWeightZeroAreIgnored) {
  const CurveEncoder encoder(model_, {.deviation_px = 0.01, .rounds = 30});
  Eigen::VectorXf points = PointsOf(2, 3);
  std::vector<float> weights = ones_;
  for (int k = 10; k < 25; ++k) weights[size_t(k)] = 0;
  const CurveCode before = encoder.Encode(View(points), weights);
  points.segment(20, 30).setConstant(1e4f);
  const CurveCode after = encoder.Encode(View(points), weights);
  EXPECT_EQ(before.numbers(), after.numbers());
  EXPECT_LT((after.points - PointsOf(2, 3)).norm(), 1e-2 * after.points.norm()) << "the gap is filled in";
}

TEST_F(CurveEncoderTest, WithoutAnyPointTheResultIsThePriorsMean) {
  const CurveEncoder encoder(model_);
  const Eigen::VectorXf points = PointsOf(0, 0);
  const CurveCode code = encoder.Encode(View(points), std::vector<float>(60, 0.0f));
  EXPECT_LT((code.u - model_.identity_factors.colwise().mean().transpose()).norm(), 1e-5);
  EXPECT_LT((code.v - model_.expression_factors.colwise().mean().transpose()).norm(), 1e-5);
}

TEST_F(CurveEncoderTest, ATightPriorKeepsItsOwnMeans) {
  const Eigen::VectorXf u = model_.identity_factors.row(4), v = model_.expression_factors.row(2);
  const CurveEncoder narrow(model_, CentredPrior(PriorOf(model_), u, v, 1e-4), {.deviation_px = 1});
  const CurveCode code = narrow.Encode(View(PointsOf(0, 0)), ones_);
  EXPECT_LT((code.u - u).norm(), 1e-3);
  EXPECT_LT((code.v - v).norm(), 1e-3);
  const CoefficientPrior other = PriorOf(testing::RandomBilinear(2, 5, 3, 1));
  testing::ExpectError([&] { CurveEncoder(model_, other); }, "a prior of 5 and 3 numbers for a model of 4 and 3");
}

/// The objective of the header, written out.
double Objective(const BilinearModel& model, const Eigen::VectorXf& u, const Eigen::VectorXf& v,
                 const Eigen::VectorXf& points, double deviation) {
  const auto prior = [](const Eigen::MatrixXf& factors, const Eigen::VectorXf& x) {
    const Eigen::RowVectorXf mean = factors.colwise().mean();
    const Eigen::RowVectorXf variance = (factors.rowwise() - mean).array().square().colwise().mean();
    return double(((x.transpose() - mean).array().square() / variance.array()).sum());
  };
  return (Reconstruct(model, u, v) - points).cast<double>().squaredNorm() / (deviation * deviation) +
         prior(model.identity_factors, u) + prior(model.expression_factors, v);
}

TEST_F(CurveEncoderTest, TheResultIsAMinimumOfTheObjective) {
  constexpr double kDeviation = 2;
  const CurveEncoder encoder(model_, {.deviation_px = kDeviation, .rounds = 60});
  Eigen::VectorXf points = PointsOf(1, 5);
  points.array() += 0.5f;
  const CurveCode code = encoder.Encode(View(points), ones_);
  const double least = Objective(model_, code.u, code.v, points, kDeviation);
  for (int k = 0; k < 7; ++k) {
    for (const float step : {-0.02f, 0.02f}) {
      Eigen::VectorXf u = code.u, v = code.v;
      (k < 4 ? u[k] : v[k - 4]) += step;
      EXPECT_GT(Objective(model_, u, v, points, kDeviation), least - 1e-4);
    }
  }
}

TEST_F(CurveEncoderTest, AStartSavesRounds) {
  const CurveEncoder patient(model_, {.deviation_px = 0.01, .rounds = 50}),
      hasty(model_, {.deviation_px = 0.01, .rounds = 1});
  const Eigen::VectorXf points = PointsOf(3, 1);
  const CurveCode start = patient.Encode(View(points), ones_);
  const auto error = [&](const CurveCode& code) { return (code.points - points).norm(); };
  EXPECT_LE(error(hasty.Encode(View(points), ones_, &start)), error(hasty.Encode(View(points), ones_)));
}

TEST_F(CurveEncoderTest, OtherNumbersOfPointsAreRefused) {
  const CurveEncoder encoder(model_);
  testing::ExpectError([&] { encoder.Encode(std::vector<float>(7), ones_); }, "7 coordinates and 60 weights");
}

}  // namespace
}  // namespace daumier::faces
