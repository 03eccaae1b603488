#include "faces/principal_components.h"

#include "core/random.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <vector>

namespace daumier::faces {
namespace {

using Snapshots = std::vector<std::vector<float>>;

Eigen::MatrixXd GramOf(const Snapshots& rows, Centring centring) {
  return GramMatrix(
      int(rows.size()), int(rows[0].size()), [&](int i) { return std::span<const float>(rows[i]); }, centring);
}

TEST(GramMatrix, IsThatByHand) {
  const Snapshots rows{{1, 2}, {3, 4}};
  Eigen::Matrix2d plain, centred;
  plain << 5, 11, 11, 25;
  centred << 2, -2, -2, 2;  // The mean is (2, 3).
  EXPECT_EQ(GramOf(rows, Centring::kNone), plain);
  EXPECT_EQ(GramOf(rows, Centring::kMean), centred);
}

TEST(GramMatrix, SumsOverMoreThanOneBlock) {
  const Snapshots rows{std::vector<float>(10000, 1.0f), std::vector<float>(10000, 2.0f)};
  Eigen::Matrix2d expected;
  expected << 10000, 20000, 20000, 40000;
  EXPECT_EQ(GramOf(rows, Centring::kNone), expected);
}

TEST(GramMatrix, NamesAFaceOfAnotherSize) {
  testing::ExpectError([] { GramOf({{1, 2}, {1}}, Centring::kNone); }, "face 1 has 1 coordinates, expected 2");
}

TEST(FindComponents, AreOrthonormalRowsAndLeaveOutRounding) {
  Rng rng(5);
  const auto draw = [&] { return rng.Normal(); };
  const Eigen::MatrixXd faces = Eigen::MatrixXd::NullaryExpr(8, 3, draw) * Eigen::MatrixXd::NullaryExpr(3, 40, draw);
  const SnapshotComponents found = FindComponents(faces * faces.transpose(), 8, 1e-9);
  ASSERT_EQ(found.variances.size(), 3) << "the faces span three directions";
  EXPECT_GE(found.variances[0], found.variances[1]);
  const Eigen::MatrixXd rows = found.weights.transpose() * faces;
  EXPECT_LT((rows * rows.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((faces * rows.transpose() * rows - faces).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FindComponents, OfEqualFacesThereIsNone) {
  EXPECT_EQ(FindComponents(GramOf({{1, 2}, {1, 2}}, Centring::kMean), 2, 1e-9).variances.size(), 0);
}

TEST(FixSign, TurnsTheLargestEntryUp) {
  Eigen::Vector3f vector(1, -3, 2);
  FixSign(vector);
  EXPECT_EQ(vector, Eigen::Vector3f(-1, 3, -2));
  FixSign(vector);
  EXPECT_EQ(vector, Eigen::Vector3f(-1, 3, -2));
}

}  // namespace
}  // namespace daumier::faces
