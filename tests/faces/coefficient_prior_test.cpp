#include "faces/coefficient_prior.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

/// Identities (3, 4) and (3, 8); expressions 1, 1 and 4.
BilinearModel ByHand() {
  BilinearModel model;
  model.num_identity = 2, model.num_expression = 1;
  model.identity_factors.resize(2, 2);
  model.identity_factors << 3, 4, 3, 8;
  model.expression_factors = Eigen::Vector3f(1, 1, 4);
  return model;
}

TEST(CoefficientPrior, IsWorkedOutByHand) {
  const CoefficientPrior prior = PriorOf(ByHand());
  EXPECT_EQ(prior.u_mean, Eigen::Vector2f(3, 6));
  EXPECT_FLOAT_EQ(prior.u_deviation[1], 2);
  EXPECT_FLOAT_EQ(prior.v_mean[0], 2);
  EXPECT_FLOAT_EQ(prior.v_deviation[0], std::sqrt(2.0f));
}

TEST(CoefficientPrior, NoDeviationIsLessThanAThousandthOfTheMean) {
  EXPECT_FLOAT_EQ(PriorOf(ByHand()).u_deviation[0], 1e-3f * std::sqrt(45.0f));
}

TEST(CoefficientPrior, CentredHasTheGivenMeansAndAShareOfTheDeviations) {
  const CoefficientPrior prior = PriorOf(ByHand());
  const CoefficientPrior centred = CentredPrior(prior, Eigen::Vector2f(7, 8), Eigen::VectorXf::Constant(1, 9), 0.5);
  EXPECT_EQ(centred.u_mean, Eigen::Vector2f(7, 8));
  EXPECT_EQ(centred.v_mean[0], 9);
  EXPECT_FLOAT_EQ(centred.u_deviation[1], 1);
  EXPECT_FLOAT_EQ(centred.v_deviation[0], std::sqrt(0.5f));
}

TEST(CoefficientPrior, RefusesOtherLengthsAndNoDeviation) {
  const CoefficientPrior prior = PriorOf(ByHand());
  testing::ExpectError([&] { CentredPrior(prior, Eigen::Vector3f(1, 2, 3), Eigen::VectorXf::Ones(1), 1); },
                       "u and v have 3 and 1 numbers, their prior 2 and 1");
  testing::ExpectError([&] { CentredPrior(prior, Eigen::Vector2f(1, 2), Eigen::VectorXf::Ones(1), 0); }, "0 times");
}

}  // namespace
}  // namespace daumier::faces
