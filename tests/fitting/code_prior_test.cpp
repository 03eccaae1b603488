#include "fitting/code_prior.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::testing {
namespace {

TEST(CodePrior, StandardisesCodes) {
  Rng rng(5);
  Eigen::MatrixXd latents(4000, 3);
  Eigen::Matrix3d mix;
  mix << 2, 0, 0, 1, 0.5, 0, -1, 0.2, 0.1;
  for (auto row : latents.rowwise())
    row = (mix * Eigen::Vector3d(rng.Normal(), rng.Normal(), rng.Normal()) + Eigen::Vector3d(1, 2, 3)).transpose();
  const fitting::CodePrior prior = fitting::PriorOfCodes(latents);
  const Eigen::MatrixXd codes = fitting::StandardisedCodes(prior, latents);
  EXPECT_LT(codes.colwise().mean().norm(), 1e-9);
  EXPECT_LT((codes.transpose() * codes / 4000.0 - Eigen::Matrix3d::Identity()).norm(), 1e-6);
  EXPECT_NEAR(prior.usual_radius, fitting::NormalRadius(3), 0.15);
  EXPECT_LT((prior.mean + prior.factor * codes.row(7).transpose() - latents.row(7).transpose()).norm(), 1e-9);
}

TEST(CodePrior, RadiusIsThatOfChiSquared) {
  EXPECT_NEAR(fitting::NormalRadius(1), 2.5758, 0.02);
  EXPECT_NEAR(fitting::NormalRadius(10), std::sqrt(23.2093), 0.01);
  EXPECT_NEAR(fitting::NormalRadius(100), std::sqrt(135.807), 0.01);
}

TEST(CodePrior, RefusesCodesWithoutSpread) {
  ExpectError([] { fitting::PriorOfCodes(Eigen::MatrixXd::Zero(1, 3)); }, "two or more");
  ExpectError([] { fitting::PriorOfCodes(Eigen::MatrixXd::Ones(5, 3)); }, "equal");
}

}  // namespace
}  // namespace daumier::testing
