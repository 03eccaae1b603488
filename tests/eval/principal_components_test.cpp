#include "eval/principal_components.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/SVD>

#include <cmath>

namespace daumier::eval {
namespace {

/// 60 vectors of 50 numbers whose deviations fall by 0.8 from one of num_directions directions to the next.
CentredRows SomeVectors(int num_directions = 40) {
  Rng rng(9);
  FaceRows scores(60, num_directions), directions(num_directions, 50);
  for (Eigen::Index k = 0; k < num_directions; ++k) {
    for (float& score : scores.col(k)) score = float(std::pow(0.8, double(k)) * rng.Normal());
    for (float& entry : directions.row(k)) entry = float(rng.Normal());
  }
  const FaceRows vectors = (scores * directions).array() + 3;
  return Centre(vectors);
}

TEST(PrincipalComponents, AreThoseOfTheSingularValueDecomposition) {
  const CentredRows vectors = SomeVectors();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(vectors.rows.cast<double>(), Eigen::ComputeThinV);
  const PrincipalComponents components = FitPrincipalComponents(vectors, 5, 1);
  EXPECT_EQ(components.mean, vectors.mean);
  const Eigen::VectorXd deviations = svd.singularValues().head(5) / std::sqrt(60.0);
  EXPECT_LT((components.deviations.cast<double>() - deviations).cwiseAbs().maxCoeff(), 1e-4 * deviations[0]);
  const Eigen::MatrixXd cosines = (components.rows.cast<double>() * svd.matrixV().leftCols(5)).cwiseAbs();
  EXPECT_LT((cosines - Eigen::MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(PrincipalComponents, AreOrthonormalAndTheSameForASeed) {
  const PrincipalComponents components = FitPrincipalComponents(SomeVectors(), 7, 4);
  const Eigen::MatrixXf products = components.rows * components.rows.transpose();
  EXPECT_LT((products - Eigen::MatrixXf::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-5f);
  EXPECT_EQ(components.rows, FitPrincipalComponents(SomeVectors(), 7, 4).rows);
}

TEST(PrincipalComponents, AreOrthonormalAlsoWhereTheVectorsVaryInFewerDirections) {
  const PrincipalComponents components = FitPrincipalComponents(SomeVectors(3), 7, 4);
  const Eigen::MatrixXf products = components.rows * components.rows.transpose();
  EXPECT_LT((products - Eigen::MatrixXf::Identity(7, 7)).cwiseAbs().maxCoeff(), 1e-5f);
  EXPECT_LT(components.deviations.tail(4).maxCoeff(), 1e-4f * components.deviations[0]);
  const PrincipalComponents none = FitPrincipalComponents(Centre(FaceRows::Constant(9, 8, 2)), 3, 1);
  EXPECT_TRUE(none.rows.allFinite());
  EXPECT_TRUE(none.deviations.isZero(0));
}

TEST(PrincipalComponents, NeedMoreVectorsThanComponents) {
  testing::ExpectError([] { FitPrincipalComponents(Centre(FaceRows::Zero(5, 9)), 5, 1); },
                       "5 principal components of 5 vectors");
}

}  // namespace
}  // namespace daumier::eval
