#include "eval/ridge_regression.h"

#include "core/error.h"
#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <numeric>
#include <set>

namespace daumier::eval {
namespace {

/// Sketches of `num_points` numbers and faces of 3 vertices that depend on them linearly, and on noise.
struct LinearWorld {
  FaceRows points, faces;
  std::set<int> vertices_read, points_read;

  LinearWorld(int num_faces, int num_points, double noise, uint64_t seed) {
    Rng rng(seed);
    points.resize(num_faces, num_points);
    Eigen::MatrixXf map(num_points, 9);
    for (float& entry : points.reshaped()) entry = float(128 + 20 * rng.Normal());
    for (float& entry : map.reshaped()) entry = float(0.05 * rng.Normal());
    faces = points * map;
    for (float& entry : faces.reshaped()) entry += float(3 + noise * rng.Normal());
  }

  SketchSamples samples() {
    return {[this](int face) {
              vertices_read.insert(face);
              return std::span<const float>(faces.row(face).data(), size_t(faces.cols()));
            },
            [this](int face) {
              points_read.insert(face);
              return std::vector<float>(points.row(face).data(), points.row(face).data() + points.cols());
            }};
  }
};

std::vector<int> Indices(int begin, int end) {
  std::vector<int> indices(end - begin);
  std::iota(indices.begin(), indices.end(), begin);
  return indices;
}

const std::vector<int> kRegion = {0, 1, 2};

TEST(RidgeRegression, EqualsTheClosedForm) {
  LinearWorld world(40, 5, 0.2, 4);
  const double lambda = 0.3;
  const auto train = Indices(0, 30), validation = Indices(30, 40);
  const RidgeFit fit = FitRidge(world.samples(), train, validation, kRegion, std::vector<double>{lambda});

  const Eigen::MatrixXd x = world.points.topRows(30).cast<double>(), y = world.faces.topRows(30).cast<double>();
  const Eigen::RowVectorXd x_mean = x.colwise().mean(), y_mean = y.colwise().mean();
  const Eigen::RowVectorXd deviation = ((x.rowwise() - x_mean).array().square().colwise().mean()).sqrt();
  const auto standardise = [&](const Eigen::MatrixXd& rows) -> Eigen::MatrixXd {
    return (rows.rowwise() - x_mean).array().rowwise() / deviation.array();
  };
  const Eigen::MatrixXd z = standardise(x);
  const Eigen::MatrixXd weights = (z.transpose() * z + 30 * lambda * Eigen::MatrixXd::Identity(5, 5))
                                      .ldlt()
                                      .solve(z.transpose() * (y.rowwise() - y_mean));
  const Eigen::MatrixXd expected =
      (standardise(world.points.bottomRows(10).cast<double>()) * weights).rowwise() + y_mean;
  const FaceRows predicted = fit.model.Predict(world.points.bottomRows(10));
  EXPECT_LT((predicted.cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(RidgeRegression, ReproducesALinearWorldAndChoosesTheLeastLambdaThere) {
  LinearWorld world(60, 5, 0, 5);
  const RidgeFit fit = FitRidge(world.samples(), Indices(0, 40), Indices(40, 50), kRegion, DefaultRidgeLambdas());
  EXPECT_DOUBLE_EQ(fit.lambda, DefaultRidgeLambdas().front());
  EXPECT_LT((fit.model.Predict(world.points.bottomRows(10)) - world.faces.bottomRows(10)).cwiseAbs().maxCoeff(), 1e-3f);
}

TEST(RidgeRegression, ChoosesAStrongLambdaWhereSketchesCarryNoInformation) {
  LinearWorld world(60, 20, 0, 6);
  Rng rng(7);
  for (float& entry : world.faces.reshaped()) entry = float(rng.Normal());
  const RidgeFit fit = FitRidge(world.samples(), Indices(0, 30), Indices(30, 60), kRegion, DefaultRidgeLambdas());
  EXPECT_GE(fit.lambda, 1.0);
  EXPECT_EQ(fit.validation_errors.size(), DefaultRidgeLambdas().size());
}

TEST(RidgeRegression, IgnoresAPointThatNeverMoves) {
  LinearWorld world(30, 4, 0, 8);
  world.points.col(2).setConstant(64);
  const RidgeFit fit = FitRidge(world.samples(), Indices(0, 20), Indices(20, 25), kRegion, std::vector<double>{1e-4});
  FaceRows moved = world.points.bottomRows(5);
  const FaceRows before = fit.model.Predict(moved);
  moved.col(2).setConstant(200);
  EXPECT_EQ(fit.model.Predict(moved), before);
}

TEST(RidgeRegression, IsTheSameWhetherFacesFitIntoOneBlockOrNot) {
  // 600 faces are three blocks; the closed form over all at once gives the same prediction.
  LinearWorld world(610, 3, 0, 9);
  const RidgeFit fit =
      FitRidge(world.samples(), Indices(0, 600), Indices(600, 605), kRegion, std::vector<double>{1e-6});
  EXPECT_LT((fit.model.Predict(world.points.bottomRows(5)) - world.faces.bottomRows(5)).cwiseAbs().maxCoeff(), 1e-3f);
}

TEST(RidgeRegression, ReadsNoFaceButTrainingAndValidationFaces) {
  LinearWorld world(50, 5, 0.1, 10);
  FitRidge(world.samples(), Indices(0, 30), Indices(30, 40), kRegion, DefaultRidgeLambdas());
  EXPECT_EQ(*world.vertices_read.rbegin(), 39);
  EXPECT_EQ(*world.points_read.rbegin(), 39);
}

TEST(RidgeRegression, PredictsOnSeveralThreadsWhatItPredictsOnOne) {
  LinearWorld world(60, 5, 0.1, 13);
  const RidgeRegression model =
      FitRidge(world.samples(), Indices(0, 40), Indices(40, 50), kRegion, std::vector<double>{0.1}).model;
  const FaceRows together = model.Predict(world.points);
  const FaceRows apart = RowsOnAllCores(60, 9, [&](int face) {
    const FaceRows one = model.Predict(world.points.row(face));
    return std::vector<float>(one.data(), one.data() + one.size());
  });
  EXPECT_LT((apart - together).cwiseAbs().maxCoeff(), 1e-4f);
}

TEST(RidgeRegression, RefusesEmptyListsAndOtherSizes) {
  LinearWorld world(10, 4, 0, 11);
  EXPECT_THROW(FitRidge(world.samples(), {}, Indices(0, 5), kRegion, DefaultRidgeLambdas()), Error);
  testing::ExpectError(
      [&] { FitRidge(world.samples(), Indices(0, 5), Indices(5, 10), std::vector<int>{3}, DefaultRidgeLambdas()); },
      "the region has vertex 3, the face 3 vertices");
  const RidgeFit fit = FitRidge(world.samples(), Indices(0, 5), Indices(5, 10), kRegion, DefaultRidgeLambdas());
  EXPECT_THROW(fit.model.Predict(FaceRows::Zero(1, 7)), Error);
}

}  // namespace
}  // namespace daumier::eval
