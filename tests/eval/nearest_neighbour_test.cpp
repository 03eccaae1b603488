#include "eval/nearest_neighbour.h"

#include "core/random.h"
#include "tests/support/expect_error.h"
#include "tests/support/from_threads.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::eval {
namespace {

FaceRows RandomRows(Eigen::Index count, Eigen::Index length, double deviation, uint64_t seed) {
  Rng rng(seed);
  FaceRows rows(count, length);
  for (float& entry : rows.reshaped()) entry = float(100 + deviation * rng.Normal());
  return rows;
}

TEST(NearestNeighbour, OfARowIsTheRow) {
  const FaceRows rows = RandomRows(20, 6, 1, 2);
  EXPECT_EQ(NearestNeighbour(rows).Nearest(rows),
            (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
}

TEST(NearestNeighbour, IsTheNearestByHandAndTheFirstOfEquals) {
  const NearestNeighbour nearest((FaceRows(3, 2) << 0, 0, 10, 0, 0, 10).finished());
  EXPECT_EQ(nearest.Nearest(std::vector<float>{7, 1}), 1);
  EXPECT_EQ(nearest.Nearest(std::vector<float>{10, 10}), 1);
}

TEST(NearestNeighbour, IsThatOfASearchInDoubleWhereFloatRoundsTheDifferenceAway) {
  // Squared norms of 6 million with differences of 0.1: |a|^2 - 2 a b in float is off by more than distances differ.
  const FaceRows rows = RandomRows(50, 600, 0.004, 3), queries = RandomRows(30, 600, 0.004, 4);
  const std::vector<int> found = NearestNeighbour(rows).Nearest(queries);
  for (Eigen::Index i = 0; i < queries.rows(); ++i) {
    Eigen::Index expected = 0;
    (rows.cast<double>().rowwise() - queries.row(i).cast<double>()).rowwise().squaredNorm().minCoeff(&expected);
    EXPECT_EQ(found[size_t(i)], expected);
  }
}

TEST(NearestNeighbour, SearchesFromSeveralThreads) {
  const NearestNeighbour nearest(RandomRows(50, 60, 1, 6));
  const FaceRows queries = RandomRows(10, 60, 1, 7);
  testing::ExpectTheSameFromThreads(10, [&] { return nearest.Nearest(queries); });
}

TEST(NearestNeighbour, RefusesNoRowsOtherLengthsAndNumbersThatAreNotFinite) {
  testing::ExpectError([] { NearestNeighbour(FaceRows(0, 2)); }, "needs training faces");
  const NearestNeighbour nearest(RandomRows(3, 2, 1, 5));
  testing::ExpectError([&] { nearest.Nearest(std::vector<float>{1, 2, 3}); }, "3 numbers, expected 2");
  testing::ExpectError(
      [&] {
        nearest.Nearest(std::vector<float>{1, std::numeric_limits<float>::infinity()});
      },
      "query 0 contains a number that is not finite");
}

}  // namespace
}  // namespace daumier::eval
