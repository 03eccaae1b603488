#include "fitting/quadratic_surface.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace daumier::fitting {
namespace {

QuadraticSurface Bowl(const Eigen::Vector2d& lowest) {
  Eigen::Matrix2d hessian;
  hessian << 4, 1, 1, 2;
  return {3 + 0.5 * lowest.dot(hessian * lowest), -hessian * lowest, hessian};
}

TEST(CompositeDesign, HasCornersEndsAndTheMiddle) {
  const Eigen::MatrixXd design = CompositeDesign(3);
  ASSERT_EQ(design.rows(), 15);
  EXPECT_EQ(design.row(0), Eigen::RowVector3d(-0.7, -0.7, -0.7));
  EXPECT_EQ(design.row(5), Eigen::RowVector3d(0.7, -0.7, 0.7));
  EXPECT_EQ(design.row(11), Eigen::RowVector3d(0, 1, 0));
  EXPECT_TRUE(design.row(14).isZero());
  EXPECT_TRUE(design.colwise().sum().isZero(1e-12));
}

TEST(QuadraticSurface, IsFoundAgainFromItsValues) {
  const QuadraticSurface bowl = Bowl({0.3, -0.4});
  const Eigen::MatrixXd places = CompositeDesign(2);
  Eigen::VectorXd values(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) values[i] = bowl.At(places.row(i).transpose());
  const QuadraticSurface found = FitQuadraticSurface(places, values);
  EXPECT_NEAR(found.value, bowl.value, 1e-12);
  EXPECT_LT((found.gradient - bowl.gradient).norm(), 1e-12);
  EXPECT_LT((found.hessian - bowl.hessian).norm(), 1e-12);
}

TEST(QuadraticSurface, LowestPlaceIsThatByHand) {
  EXPECT_LT((Bowl({0.3, -0.4}).LowestInBox() - Eigen::Vector2d(0.3, -0.4)).norm(), 1e-9);
  // Beyond the box: on the side x = 1, where y minimises the rest: 2 (y - 0) + 1 (1 - 3) = 0.
  EXPECT_LT((Bowl({3, 0}).LowestInBox() - Eigen::Vector2d(1, 1)).norm(), 1e-9);
  const QuadraticSurface saddle{0, Eigen::Vector2d(0, 0.1), Eigen::Vector2d(1, -1).asDiagonal()};
  EXPECT_LT((saddle.LowestInBox() - Eigen::Vector2d(0, -1)).norm(), 1e-9);
}

TEST(QuadraticSurface, SmoothsNoise) {
  const QuadraticSurface bowl = Bowl({0.2, 0.1});
  const Eigen::MatrixXd places = CompositeDesign(2);
  Eigen::VectorXd values(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    values[i] = bowl.At(places.row(i).transpose()) + 0.05 * std::sin(7.0 * double(i));
  EXPECT_LT((FitQuadraticSurface(places, values).LowestInBox() - Eigen::Vector2d(0.2, 0.1)).norm(), 0.05);
}

TEST(QuadraticSurface, AWeightIsTheNumberOfEqualValues) {
  const Eigen::MatrixXd places = CompositeDesign(2);
  Eigen::VectorXd values(places.rows()), weights = Eigen::VectorXd::Ones(places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) values[i] = std::sin(7.0 * double(i));
  weights[2] = 2;
  weights[5] = 0;
  Eigen::MatrixXd repeated = places;
  repeated.row(5) = places.row(2);
  Eigen::VectorXd repeated_values = values;
  repeated_values[5] = values[2];
  const QuadraticSurface weighted = FitQuadraticSurface(places, values, weights),
                         doubled = FitQuadraticSurface(repeated, repeated_values);
  EXPECT_NEAR(weighted.value, doubled.value, 1e-10);
  EXPECT_LT((weighted.gradient - doubled.gradient).norm(), 1e-10);
  EXPECT_LT((weighted.hessian - doubled.hessian).norm(), 1e-10);
}

TEST(SpreadDesign, FillsTheCubeEvenly) {
  const Eigen::MatrixXd design = SpreadDesign(3, 0, 64);
  EXPECT_LE(design.cwiseAbs().maxCoeff(), 1.0);
  // The moments of the cube: 0 and I / 3. Of as many random numbers they deviate by some 0.07 and 0.04.
  EXPECT_LT(design.colwise().mean().cwiseAbs().maxCoeff(), 0.03);
  EXPECT_LT((design.transpose() * design / 64 - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 0.03);
}

TEST(SpreadDesign, ContinuesWhereItEnded) {
  const Eigen::MatrixXd whole = SpreadDesign(3, 0, 10);
  EXPECT_EQ(SpreadDesign(3, 4, 6), Eigen::MatrixXd(whole.bottomRows(6)));
  // In one dimension g is the golden ratio: g^2 = g + 1.
  EXPECT_NEAR(SpreadDesign(1, 0, 1)(0, 0), 2 * (0.5 + 0.6180339887498949 - 1) - 1, 1e-12);
}

TEST(QuadraticSurface, RefusesTooFewOrInfiniteValues) {
  testing::ExpectError([] { FitQuadraticSurface(Eigen::MatrixXd::Zero(5, 2), Eigen::VectorXd::Zero(5)); },
                       "5 values at 5 places do not determine a quadratic surface of 2 variables");
  Eigen::VectorXd values = Eigen::VectorXd::Zero(9);
  values[3] = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { FitQuadraticSurface(CompositeDesign(2), values); }, "finite");
  values[3] = 0;
  testing::ExpectError([&] { FitQuadraticSurface(CompositeDesign(2), values, -Eigen::VectorXd::Ones(9)); },
                       "9 weights of 9 values (expected one each, not negative)");
}

}  // namespace
}  // namespace daumier::fitting
