#include "faces/landmark_order.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::faces {
namespace {

using geometry::Vector3;
using testing::ExpectError;

/// Points (n, 1, 2) of the numbers n.
MarkedPoints PointsOf(int first, int last, int step = 1) {
  MarkedPoints marked{.file = "a.txt"};
  for (int n = first; n != last + step; n += step) marked.points.emplace_back(Vector3(n, 1, 2));
  return marked;
}

TEST(LandmarkOrder, AllOrWithoutTheContour) {
  const OrderedLandmarks all = OrderLandmarks(PointsOf(0, 67));
  EXPECT_EQ(all.points[0], Vector3(0, 1, 2));
  EXPECT_EQ(all.points[67], Vector3(67, 1, 2));
  const OrderedLandmarks inner = OrderLandmarks(PointsOf(17, 67));
  EXPECT_FALSE(inner.points[16]);
  EXPECT_EQ(inner.points[17], Vector3(17, 1, 2));
  EXPECT_EQ(inner.points[67], Vector3(67, 1, 2));
}

TEST(LandmarkOrder, NumbersNameTheLandmarks) {
  for (const int base : {0, 1}) {
    MarkedPoints reversed = PointsOf(67, 0, -1);
    for (const auto& point : reversed.points) reversed.labels.push_back("LM" + std::to_string(int(point->x()) + base));
    EXPECT_EQ(OrderLandmarks(reversed).points[5], Vector3(5, 1, 2));
    reversed.points.erase(reversed.points.begin() + 10);  // Landmark 57.
    reversed.labels.erase(reversed.labels.begin() + 10);
    const OrderedLandmarks some = OrderLandmarks(reversed);
    EXPECT_FALSE(some.points[57]);
    EXPECT_EQ(some.points[58], Vector3(58, 1, 2));
  }
  MarkedPoints named = PointsOf(0, 67);
  for (int n = 0; n < 68; ++n) named.labels.push_back(n % 2 ? "a" : "b");
  EXPECT_EQ(OrderLandmarks(named).points[5], Vector3(5, 1, 2));
  MarkedPoints inner = PointsOf(17, 67);
  for (int n = 18; n <= 68; ++n) inner.labels.push_back(std::to_string(n));
  EXPECT_EQ(OrderLandmarks(inner).points[17], Vector3(17, 1, 2));
}

TEST(LandmarkOrder, NumbersWithoutRows) {
  MarkedPoints flat{.file = "a.txt", .dimension = 1};
  for (int n = 0; n < 3 * 68; ++n) flat.points.emplace_back(Vector3(n, 0, 0));
  flat.points[3].reset();
  const OrderedLandmarks places = OrderLandmarks(flat);
  EXPECT_EQ(places.dimension, 3);
  EXPECT_FALSE(places.points[1]);
  EXPECT_EQ(places.points[2], Vector3(6, 7, 8));
  flat.points.resize(68);
  EXPECT_EQ(OrderLandmarks(flat).dimension, 1);
}

TEST(LandmarkOrder, OtherCountsAreRefusedWithTheForms) {
  ExpectError([] { OrderLandmarks(PointsOf(0, 66)); }, "a.txt: 67 points; expected 68 points in iBUG order, the 51");
  MarkedPoints unclear = PointsOf(0, 5);
  for (int n = 3; n < 9; ++n) unclear.labels.push_back(std::to_string(n));  // From 0 or from 1?
  ExpectError([&] { OrderLandmarks(unclear); }, "6 points; expected 68");
}

TEST(LandmarkOrder, TheOtherSideOfTheFace) {
  for (int l = 0; l < kNumLandmarks; ++l) EXPECT_EQ(MirroredLandmark(MirroredLandmark(l)), l);
  const int pairs[][2] = {{0, 16},  {8, 8},   {17, 26}, {21, 22}, {30, 30}, {31, 35}, {36, 45},
                          {41, 46}, {48, 54}, {59, 55}, {57, 57}, {60, 64}, {67, 65}, {66, 66}};
  for (const auto& [right, left] : pairs) EXPECT_EQ(MirroredLandmark(right), left);
  ExpectError([] { MirroredLandmark(68); }, "landmark 68 of 68");
}

}  // namespace
}  // namespace daumier::faces
