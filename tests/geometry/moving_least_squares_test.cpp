#include "geometry/moving_least_squares.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>

namespace daumier::geometry {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using PointList = std::vector<Vector2d>;

constexpr PlanarMap kKinds[] = {PlanarMap::kSimilarity, PlanarMap::kRigid};

PointList RandomPoints(int count, Rng& rng) {
  PointList points;
  for (int i = 0; i < count; ++i) points.emplace_back(rng.Uniform(0, 256), rng.Uniform(0, 256));
  return points;
}

PointList Moved(const PointList& points, double pixels, Rng& rng) {
  PointList moved = points;
  for (Vector2d& point : moved) point += pixels * Vector2d(rng.Normal(), rng.Normal());
  return moved;
}

/// Row i: sqrt(w_i).
Eigen::VectorXd RootWeights(const PointList& handles, const Vector2d& v) {
  Eigen::VectorXd roots(handles.size());
  for (size_t i = 0; i < handles.size(); ++i) roots[i] = 1 / std::sqrt(std::pow((handles[i] - v).norm(), 4) + 1e-8);
  return roots;
}

/// l_v(v) of the best similarity, as a general least-squares problem in (a, b, x, y): p -> (a px - b py + x, b px + a
/// py + y).
Vector2d SimilarityBySvd(const PointList& handles, const PointList& targets, const Vector2d& v) {
  const Eigen::VectorXd roots = RootWeights(handles, v);
  Eigen::MatrixXd system(2 * handles.size(), 4);
  Eigen::VectorXd right(2 * handles.size());
  for (size_t i = 0; i < handles.size(); ++i) {
    const Vector2d p = handles[i] - v;
    system.row(2 * i) << roots[i] * p.x(), -roots[i] * p.y(), roots[i], 0;
    system.row(2 * i + 1) << roots[i] * p.y(), roots[i] * p.x(), 0, roots[i];
    right.segment<2>(2 * i) = roots[i] * targets[i];
  }
  return system.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(right).tail<2>();
}

/// The same of the best rotation with translation, by the SVD of the covariance.
Vector2d RigidBySvd(const PointList& handles, const PointList& targets, const Vector2d& v) {
  const Eigen::VectorXd weights = RootWeights(handles, v).array().square();
  Vector2d source = Vector2d::Zero(), target = Vector2d::Zero();
  for (size_t i = 0; i < handles.size(); ++i) {
    source += weights[i] / weights.sum() * handles[i];
    target += weights[i] / weights.sum() * targets[i];
  }
  Matrix2d covariance = Matrix2d::Zero();
  for (size_t i = 0; i < handles.size(); ++i)
    covariance += weights[i] * (targets[i] - target) * (handles[i] - source).transpose();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Vector2d sign(1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose() * (v - source) + target;
}

TEST(MovingLeastSquares, FollowsTwoHandlesByHand) {
  // (0, 0) stays and (10, 0) goes to (0, 20): turned by 90 degrees and doubled. A rigid motion cannot double: half-way
  // between the handles both weigh the same, so that the middle goes to the middle.
  const PointList handles{{0, 0}, {10, 0}}, targets{{0, 0}, {0, 20}};
  const MovingLeastSquares similarity(handles, targets, PlanarMap::kSimilarity);
  EXPECT_LT((similarity.Apply({5, 0}) - Vector2d(0, 10)).norm(), 1e-9);
  EXPECT_LT((similarity.Apply({7, 3}) - Vector2d(-6, 14)).norm(), 1e-9);
  const MovingLeastSquares rigid(handles, targets, PlanarMap::kRigid);
  EXPECT_LT((rigid.Apply({5, 0}) - Vector2d(0, 10)).norm(), 1e-9);
  EXPECT_LT((rigid.Apply({5, 2}) - Vector2d(-2, 10)).norm(), 1e-9);
}

TEST(MovingLeastSquares, HandlesGoToTheirTargets) {
  Rng rng(1);
  const PointList handles = RandomPoints(7, rng), targets = Moved(handles, 20, rng);
  for (const PlanarMap kind : kKinds) {
    const MovingLeastSquares map(handles, targets, kind);
    for (size_t i = 0; i < handles.size(); ++i) EXPECT_LT((map.Apply(handles[i]) - targets[i]).norm(), 1e-8);
  }
}

TEST(MovingLeastSquares, ReproducesASimilarityAndARigidMotion) {
  Rng rng(2);
  const PointList handles = RandomPoints(5, rng);
  const Matrix2d rotation = Eigen::Rotation2Dd(0.7).toRotationMatrix();
  for (const PlanarMap kind : kKinds) {
    const Matrix2d linear = kind == PlanarMap::kRigid ? rotation : Matrix2d(1.8 * rotation);
    const auto known = [&](const Vector2d& p) -> Vector2d { return linear * p + Vector2d(11, -30); };
    PointList targets;
    for (const Vector2d& handle : handles) targets.push_back(known(handle));
    const MovingLeastSquares map(handles, targets, kind);
    for (const Vector2d& point : RandomPoints(50, rng)) EXPECT_LT((map.Apply(point) - known(point)).norm(), 1e-9);
    EXPECT_LT((map.Apply({-5000, 9000}) - known({-5000, 9000})).norm(), 1e-6);
  }
}

TEST(MovingLeastSquares, LeavesAllWhereHandlesStay) {
  Rng rng(3);
  const PointList handles = RandomPoints(4, rng);
  for (const PlanarMap kind : kKinds) {
    const MovingLeastSquares map(handles, handles, kind);
    for (const Vector2d& point : RandomPoints(20, rng)) EXPECT_LT((map.Apply(point) - point).norm(), 1e-11);
  }
}

TEST(MovingLeastSquares, SolvesTheWeightedLeastSquaresProblem) {
  Rng rng(4);
  for (int trial = 0; trial < 40; ++trial) {
    const PointList handles = RandomPoints(2 + trial % 5, rng), targets = Moved(handles, 15, rng);
    const MovingLeastSquares similarity(handles, targets, PlanarMap::kSimilarity);
    const MovingLeastSquares rigid(handles, targets, PlanarMap::kRigid);
    const Vector2d v(rng.Uniform(0, 256), rng.Uniform(0, 256));
    EXPECT_LT((similarity.Apply(v) - SimilarityBySvd(handles, targets, v)).norm(), 1e-7);
    EXPECT_LT((rigid.Apply(v) - RigidBySvd(handles, targets, v)).norm(), 1e-7);
  }
}

TEST(MovingLeastSquares, MovesRigidlyFarFromTheHandles) {
  Rng rng(5);
  const PointList handles = RandomPoints(6, rng);
  const MovingLeastSquares map(handles, Moved(handles, 30, rng), PlanarMap::kRigid);
  const Vector2d v(3e5, -4e5);
  const double step = 10;
  Matrix2d jacobian;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2d offset = step * Vector2d::Unit(axis);
    jacobian.col(axis) = (map.Apply(v + offset) - map.Apply(v - offset)) / (2 * step);
  }
  EXPECT_LT((jacobian.transpose() * jacobian - Matrix2d::Identity()).norm(), 1e-3);
  EXPECT_NEAR(jacobian.determinant(), 1, 1e-3);
}

TEST(MovingLeastSquares, AHandleAloneTranslates) {
  for (const PlanarMap kind : kKinds) {
    const MovingLeastSquares map({{3, 4}}, {{5, 1}}, kind);
    EXPECT_EQ(map.Apply({100, 50}), Vector2d(102, 47));
    EXPECT_EQ(map.Apply({3, 4}), Vector2d(5, 1));
  }
}

TEST(MovingLeastSquares, WithoutHandlesNothingMoves) {
  EXPECT_EQ(MovingLeastSquares({}, {}, PlanarMap::kRigid).Apply({100, 50}), Vector2d(100, 50));
}

TEST(MovingLeastSquares, HandlesInOnePointActAsOneThatWeighsAsMuch) {
  const Vector2d p(30, 40), other(90, 10);
  for (const PlanarMap kind : kKinds) {
    const MovingLeastSquares alone({p, p}, {{30, 42}, {36, 40}}, kind);
    EXPECT_EQ(alone.Apply(p), Vector2d(33, 41));
    EXPECT_EQ(alone.Apply({0, 0}), Vector2d(3, 1));
  }
  const PointList handles{p, other, p}, targets{{30, 42}, {95, 15}, {36, 40}};
  const Vector2d v(60, 30);
  EXPECT_LT(
      (MovingLeastSquares(handles, targets, PlanarMap::kSimilarity).Apply(v) - SimilarityBySvd(handles, targets, v))
          .norm(),
      1e-9);
  EXPECT_LT((MovingLeastSquares(handles, targets, PlanarMap::kRigid).Apply(v) - RigidBySvd(handles, targets, v)).norm(),
            1e-9);
}

TEST(MovingLeastSquares, IsFiniteWhereTargetsMeet) {
  const PointList handles{{0, 0}, {10, 0}}, together{{4, 4}, {4, 4}};
  EXPECT_LT((MovingLeastSquares(handles, together, PlanarMap::kSimilarity).Apply({7, 9}) - Vector2d(4, 4)).norm(),
            1e-12);
  EXPECT_TRUE(MovingLeastSquares(handles, together, PlanarMap::kRigid).Apply({7, 9}).allFinite());
}

TEST(MovingLeastSquares, RefusesMoreTargetsThanHandles) {
  testing::ExpectError(
      [] {
        MovingLeastSquares({{0, 0}}, {{1, 1}, {2, 2}}, PlanarMap::kRigid);
      },
      "1 handles have 2 targets");
}

}  // namespace
}  // namespace daumier::geometry
