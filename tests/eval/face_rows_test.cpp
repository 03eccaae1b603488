#include "eval/face_rows.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

namespace daumier::eval {
namespace {

TEST(RowsOnAllCores, KeepsTheOrderOfRowsWhateverHoldsThem) {
  const FaceRows expected = (FaceRows(3, 2) << 0, 1, 10, 11, 20, 21).finished();
  EXPECT_EQ(RowsOnAllCores(3, 2,
                           [](int i) {
                             return std::vector<float>{10.0f * float(i), 10.0f * float(i) + 1};
                           }),
            expected);
  EXPECT_EQ(RowsOnAllCores(
                3, 2, [](int i) { return Eigen::VectorXf(Eigen::Vector2f(10.0f * float(i), 10.0f * float(i) + 1)); }),
            expected);
  EXPECT_EQ(RowSpan(expected, 1)[1], 11);
}

/// Faces 0, 1, 2, of two numbers each, that remember which of them were read.
struct Faces {
  FaceRows rows = (FaceRows(3, 2) << 1, 10, 4, 20, 100, -7).finished();
  std::set<int> read;

  FaceReader reader() {
    return [this](int face) {
      read.insert(face);
      return RowSpan(rows, size_t(face));
    };
  }
};

TEST(ReadRows, HoldsTheFacesInTheirOrderAndReadsNoOther) {
  Faces faces;
  const std::vector<int> chosen = {2, 0};
  EXPECT_EQ(ReadRows(faces.reader(), chosen), faces.rows(chosen, Eigen::all));
  EXPECT_EQ(faces.read, (std::set<int>{0, 2}));
  EXPECT_EQ(ReadRows(faces.reader(), {}).size(), 0);
  const auto longer = [](int face) { return std::vector<float>(size_t(face + 1)); };
  testing::ExpectError([&] { ReadRows(longer, chosen); }, "face 0 has 1 numbers, others have 3");
}

TEST(MeanFace, IsTheMeanOfTheGivenFacesAndReadsNoOther) {
  Faces faces;
  EXPECT_EQ(MeanFace(faces.reader(), std::vector<int>{0, 1}), Eigen::RowVector2f(2.5f, 15));
  EXPECT_EQ(faces.read, (std::set<int>{0, 1}));
  testing::ExpectError([&] { MeanFace(faces.reader(), {}); }, "needs training faces");
}

TEST(MeanFace, IsExactWhereASumInFloatIsNot) {
  const std::vector<float> big = {1e8f}, small = {1};
  const FaceReader reader = [&](int face) { return std::span<const float>(face == 0 ? big : small); };
  std::vector<int> faces(101, 1);
  faces[0] = 0;
  EXPECT_EQ(MeanFace(reader, faces)[0], float((1e8 + 100) / 101));
}

TEST(Centre, SubtractsTheMeanOfTheRows) {
  const CentredRows centred = Centre((FaceRows(2, 2) << 1, 10, 4, 20).finished());
  EXPECT_EQ(centred.mean, Eigen::RowVector2f(2.5f, 15));
  EXPECT_EQ(centred.rows, (FaceRows(2, 2) << -1.5f, -5, 1.5f, 5).finished());
}

TEST(Centre, RefusesNoRowsAndNumbersThatAreNotFinite) {
  testing::ExpectError([] { Centre(FaceRows(0, 3)); }, "a mean needs faces");
  FaceRows rows = FaceRows::Zero(3, 2);
  rows(1, 1) = std::numeric_limits<float>::quiet_NaN();
  testing::ExpectError([&] { Centre(rows); }, "row 1 contains a number that is not finite");
}

}  // namespace
}  // namespace daumier::eval
