#include "faces/bilinear_projector.h"

#include "tests/faces/random_tensor.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/QR>

#include <algorithm>
#include <limits>

namespace daumier::faces {
namespace {

using testing::ExpectError;

/// Alternating least squares on the core itself, as the projector's second way; the weighted squared error it ends at.
double AlternatingError(const BilinearModel& model, const Eigen::VectorXd& weights, const Eigen::VectorXd& face,
                        Eigen::VectorXd v, int rounds) {
  const int ku = model.num_identity, kv = model.num_expression;
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const Eigen::MatrixXd core = model.core.cast<double>() * roots.asDiagonal();
  const Eigen::VectorXd target = face.cwiseProduct(roots);
  Eigen::MatrixXd of_u(face.size(), ku), of_v(face.size(), kv);
  Eigen::VectorXd u;
  for (int round = 0; round < rounds; ++round) {
    for (int k = 0; k < ku; ++k) of_u.col(k) = core.middleRows(k * kv, kv).transpose() * v;
    u = of_u.colPivHouseholderQr().solve(target);
    of_v.setZero();
    for (int k = 0; k < ku; ++k) of_v += u(k) * core.middleRows(k * kv, kv).transpose();
    v = of_v.colPivHouseholderQr().solve(target);
  }
  return (of_v * v - target).squaredNorm();
}

TEST(BilinearProjector, FittedFaceIsReturned) {
  const Tensor tensor = RandomTensor(10, 6, 90, 13);
  const BilinearModel model = tensor.Fit(5, 4);
  const BilinearProjector projector(model);
  for (const auto& [i, e] : {std::pair{0, 0}, {3, 5}, {9, 2}}) {
    const Eigen::VectorXf face = FittedFace(model, i, e);
    const BilinearProjection projection = projector.Project({face.data(), static_cast<size_t>(face.size())});
    EXPECT_LT((projection.vertices - face).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((projection.u - model.identity_factors.row(i).transpose()).norm(), 1e-3);
    EXPECT_LT((projection.v - model.expression_factors.row(e).transpose()).norm(), 1e-3);
  }
}

TEST(BilinearProjector, VIsAsLongAsAFittedExpressionAndOnItsSide) {
  const Tensor tensor = RandomTensor(10, 6, 90, 14);
  const BilinearModel model = tensor.Fit(5, 4);
  Rng rng(15);
  const Eigen::VectorXf face = RandomMatrix(90, 1, rng) * 10;
  const BilinearProjection projection = BilinearProjector(model).Project({face.data(), 90});
  EXPECT_LT((model.expression_factors.rowwise().norm().array() - projection.v.norm()).abs().minCoeff(), 1e-5);
  EXPECT_GE((model.expression_factors * projection.v).maxCoeff(), 0);
  EXPECT_EQ(projection.vertices, Reconstruct(model, projection.u, projection.v));
}

TEST(BilinearProjector, NoNeighbourIsCloser) {
  const Tensor tensor = RandomTensor(10, 6, 90, 16);
  const BilinearModel model = tensor.Fit(5, 4);
  Rng rng(17);
  const Eigen::VectorXf weights = RandomMatrix(90, 1, rng).cwiseAbs();
  const Eigen::VectorXf face = tensor.face(4, 2) + RandomMatrix(90, 1, rng);
  const auto error = [&](const Eigen::VectorXf& u, const Eigen::VectorXf& v) {
    return (Reconstruct(model, u, v) - face).cwiseAbs2().cwiseProduct(weights).sum();
  };
  const BilinearProjection best = BilinearProjector(model, weights).Project({face.data(), 90});
  const float least = error(best.u, best.v);
  for (int trial = 0; trial < 50; ++trial) {
    EXPECT_GE(error(best.u + RandomMatrix(5, 1, rng) * 0.05f, best.v + RandomMatrix(4, 1, rng) * 0.01f), least - 1e-3f);
  }
  for (int i = 0; i < 10; ++i) {
    for (int e = 0; e < 6; ++e) {
      EXPECT_GE(error(model.identity_factors.row(i), model.expression_factors.row(e)), least);
    }
  }
}

TEST(BilinearProjector, EndsWhereAlternatingLeastSquaresEnd) {
  const Tensor tensor = RandomTensor(10, 6, 90, 20);
  const BilinearModel model = tensor.Fit(5, 4);
  Rng rng(21);
  for (int trial = 0; trial < 8; ++trial) {
    const Eigen::VectorXf weights = RandomMatrix(90, 1, rng).cwiseAbs();
    const Eigen::VectorXf face = tensor.face(trial, 2) + RandomMatrix(90, 1, rng);
    const BilinearProjection projection = BilinearProjector(model, weights).Project({face.data(), 90});
    const double error = (projection.vertices - face).cast<double>().cwiseAbs2().dot(weights.cast<double>());
    const double alternating =
        AlternatingError(model, weights.cast<double>(), face.cast<double>(), projection.v.cast<double>(), 2000);
    EXPECT_NEAR(error, alternating, 1e-4 * alternating);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < 6; ++e) {
      least = std::min(least, AlternatingError(model, weights.cast<double>(), face.cast<double>(),
                                               model.expression_factors.row(e).transpose().cast<double>(), 2000));
    }
    EXPECT_LT(error, 1.05 * least);
  }
}

TEST(BilinearProjector, CoordinatesOfWeightZeroDoNotMatter) {
  const Tensor tensor = RandomTensor(10, 6, 90, 18);
  const BilinearModel model = tensor.Fit(5, 4);
  Eigen::VectorXf weights = Eigen::VectorXf::Ones(90);
  weights.head(10).setZero();
  Eigen::VectorXf face = FittedFace(model, 2, 3);
  const Eigen::VectorXf truth = face;
  face.head(10).setConstant(50);
  const BilinearProjection projection = BilinearProjector(model, weights).Project({face.data(), 90});
  EXPECT_LT((projection.vertices - truth).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(BilinearProjector, RefusesOtherSizes) {
  const BilinearModel model = RandomTensor(6, 5, 30, 19).Fit(3, 3);
  const std::vector<float> face(27);
  ExpectError([&] { BilinearProjector(model).Project(face); }, "face has 27 coordinates");
  ExpectError([&] { BilinearProjector(model, Eigen::VectorXf::Ones(29)); }, "29 weights");
  ExpectError([&] { BilinearProjector(model, -Eigen::VectorXf::Ones(30)); }, "negative weight");
  ExpectError([&] { Reconstruct(model, Eigen::VectorXf::Ones(2), Eigen::VectorXf::Ones(3)); }, "u has 2");
}

}  // namespace
}  // namespace daumier::faces
