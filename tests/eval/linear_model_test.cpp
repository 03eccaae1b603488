#include "eval/linear_model.h"

#include "core/random.h"
#include "eval/metrics.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <limits>

namespace daumier::eval {
namespace {

/// MakeFaces of 20 vertices in a space of three directions and, with noise, near it.
FaceRows MakeFaces(Eigen::Index count, uint64_t seed, double noise = 0) {
  Rng axes_rng(9), rng(seed);
  FaceRows axes(3, 60), scores(count, 3);
  Eigen::RowVectorXf mean(60);
  for (float& entry : axes.reshaped()) entry = float(axes_rng.Normal());
  for (float& entry : mean) entry = float(axes_rng.Normal());
  for (float& entry : scores.reshaped()) entry = float(rng.Normal());
  FaceRows faces = (scores * axes).rowwise() + mean;
  for (float& entry : faces.reshaped()) entry += float(noise * rng.Normal());
  return faces;
}

TEST(LinearModel, ReconstructsFacesOfItsSpace) {
  const LinearModel model = FitLinearModel(Centre(MakeFaces(30, 1)), MakeFaces(4, 2), 3, 1);
  EXPECT_EQ(model.ridge, 0) << "without noise nothing is gained by a prior";
  EXPECT_LT(MeanVertexDistance(model.Predict(MakeFaces(5, 3)), MakeFaces(5, 3)), 1e-4);
  const LinearModel smaller = FitLinearModel(Centre(MakeFaces(30, 1)), MakeFaces(4, 2), 2, 1);
  EXPECT_GT(MeanVertexDistance(smaller.Predict(MakeFaces(5, 3)), MakeFaces(5, 3)), 0.05);
}

TEST(LinearModel, IsTheLeastSquaresOneThatIsDrawnToTheMean) {
  const LinearModel model = FitLinearModel(Centre(MakeFaces(12, 1, 0.3)), MakeFaces(20, 2, 0.3), 11, 1);
  EXPECT_GT(model.ridge, 0);
  const FaceRows faces = MakeFaces(3, 3, 0.3);
  const Eigen::MatrixXd d = model.components.rows.cast<double>();
  const Eigen::RowVectorXd mean = model.components.mean.cast<double>();
  const Eigen::ArrayXd variances = model.components.deviations.cast<double>().array().square();
  // By the normal equations of |x - c D|^2 + ridge mean(v) sum c_k^2 / v_k.
  Eigen::MatrixXd matrix = d * d.transpose();
  matrix += (model.ridge * variances.mean() / variances).matrix().asDiagonal();
  const Eigen::MatrixXd scores = (faces.cast<double>().rowwise() - mean) * d.transpose() * matrix.inverse();
  const Eigen::MatrixXd expected = (scores * d).rowwise() + mean;
  EXPECT_LT((model.Predict(faces).cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(LinearModel, UsesNoDirectionWithoutVariance) {
  const LinearModel model = FitLinearModel(Centre(FaceRows::Constant(6, 9, 2)), FaceRows::Constant(2, 9, 5), 4, 1);
  EXPECT_EQ(model.Predict(FaceRows::Constant(1, 9, 5)), FaceRows::Constant(1, 9, 2)) << "the mean";
}

TEST(LinearModel, HasAtMostOneComponentLessThanTrainingFaces) {
  EXPECT_EQ(FitLinearModel(Centre(MakeFaces(6, 1, 0.3)), MakeFaces(4, 2), 128, 1).components.rows.rows(), 5);
}

TEST(LinearModel, CountsTheComponentsThatExplainAShare) {
  const CentredRows training = Centre(MakeFaces(30, 1));
  const Eigen::ArrayXd variances =
      Eigen::JacobiSVD<Eigen::MatrixXd>(training.rows.cast<double>()).singularValues().array().square();
  const double first = variances[0] / variances.sum();
  const LinearModel model = FitLinearModel(training, MakeFaces(4, 2), 2, 1);
  EXPECT_EQ(model.ComponentsFor(first - 0.01), 1);
  EXPECT_EQ(model.ComponentsFor(first + 0.01), 2);
  EXPECT_EQ(model.ComponentsFor(0.9999), std::nullopt) << "there are three directions";
}

TEST(LinearModel, RefusesTooFewFacesOtherLengthsAndNumbersThatAreNotFinite) {
  testing::ExpectError([] { FitLinearModel(Centre(MakeFaces(1, 1)), MakeFaces(4, 2), 3, 1); }, "not 1");
  testing::ExpectError([] { FitLinearModel(Centre(MakeFaces(9, 1)), MakeFaces(0, 2), 3, 1); }, "none");
  FaceRows validation = MakeFaces(4, 2);
  validation(1, 7) = std::numeric_limits<float>::quiet_NaN();
  testing::ExpectError([&] { FitLinearModel(Centre(MakeFaces(9, 1)), validation, 3, 1); }, "finite");
  const LinearModel model = FitLinearModel(Centre(MakeFaces(9, 1)), MakeFaces(4, 2), 3, 1);
  testing::ExpectError([&] { model.Predict(FaceRows::Zero(1, 57)); }, "57 coordinates, expected 60");
}

}  // namespace
}  // namespace daumier::eval
