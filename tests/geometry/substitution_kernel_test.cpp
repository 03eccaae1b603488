#include "geometry/substitution_kernel.h"

#include "core/random.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <vector>

namespace daumier::geometry {
namespace {

using Block = Eigen::Matrix<double, Eigen::Dynamic, kBlockColumns, Eigen::RowMajor>;

Block RandomBlock(Eigen::Index count) {
  Rng rng(3);
  Block block(count, kBlockColumns);
  for (double& x : block.reshaped()) x = rng.Normal();
  return block;
}

TEST(SubstitutionKernel, SolvesTheRowsThatAreKept) {
  // Rows 0 and 2 to 4 of a factor of five rows, of which row 1 is not coupled to them.
  const Eigen::Matrix<double, 5, 5> lower = (Eigen::Matrix<double, 5, 5>() << 2, 0, 0, 0, 0,  //
                                             0, 7, 0, 0, 0,                                   //
                                             1, 0, 4, 0, 0,                                   //
                                             0, 0, 3, 5, 0,                                   //
                                             6, 0, 0, 1, 8)
                                                .finished();
  const std::vector<int> starts = {0, 3, 4, 6, 8, 9}, rows = {0, 2, 4, 1, 2, 3, 3, 4, 4};
  const std::vector<double> values = {2, 1, 6, 7, 4, 3, 5, 1, 8};
  const std::vector<int> kept = {0, 2, 3, 4}, place = {0, -1, 1, 2, 3};
  const Block right = RandomBlock(4);
  Block found = right;
  SubstituteBlock({starts.data(), rows.data(), values.data()}, kept.data(), place.data(), 0, 4, found.data());
  const Eigen::MatrixXd of_kept = lower(kept, kept);
  EXPECT_LT((found - of_kept.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd(right))).cwiseAbs().maxCoeff(),
            1e-14);
  Block late = right;
  late.topRows(2).setZero();
  const Block before = late;
  SubstituteBlock({starts.data(), rows.data(), values.data()}, kept.data(), place.data(), 2, 4, late.data());
  EXPECT_LT((late - of_kept.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd(before))).cwiseAbs().maxCoeff(),
            1e-14);
}

TEST(SubstitutionKernel, SolvesForwardsAndBackwards) {
  const Eigen::Matrix3d lower = (Eigen::Matrix3d() << 2, 0, 0, 1, 4, 0, 0, 3, 5).finished();
  const std::vector<int> starts = {0, 2, 4, 5}, rows = {0, 1, 1, 2, 2};
  const std::vector<double> values = {2, 1, 4, 3, 5};
  const FactorColumns columns{starts.data(), rows.data(), values.data()};
  using Rows = Eigen::Matrix<double, 3, kSolvedColumns, Eigen::RowMajor>;
  const Rows right = RandomBlock(3).leftCols<kSolvedColumns>();
  Rows forwards = right, backwards = right;
  SubstituteForwards(columns, 3, forwards.data());
  SubstituteBackwards(columns, 3, backwards.data());
  EXPECT_LT((lower * forwards - right).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LT((lower.transpose() * backwards - right).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(SubstitutionKernel, ProductsOfBlocks) {
  const Block a = RandomBlock(11), b = a.colwise().reverse();
  Eigen::Matrix<double, kBlockColumns, kBlockColumns, Eigen::RowMajor> found;
  MultiplyBlocks(a.data(), b.data(), 3, 11, found.data());
  EXPECT_LT((found - a.bottomRows(8).transpose() * b.bottomRows(8)).cwiseAbs().maxCoeff(), 1e-14);
}

}  // namespace
}  // namespace daumier::geometry
