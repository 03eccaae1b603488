#include "faces/import/number_array.h"

#include "tests/faces/import/foreign_files.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::faces {
namespace {

using testing::BytesOf;
using testing::ExpectError;
using Type = NumberArray::Type;
using Order = NumberArray::Order;

NumberArray Floats(std::vector<int64_t> shape, const std::vector<float>& values) {
  return {Type::kF32, std::move(shape), Order::kRowMajor, BytesOf(values), "m: a"};
}

TEST(NumberArray, EveryTypeIsRead) {
  const auto first = [](Type type, const std::string& bytes) {
    return NumberArray(type, {1}, Order::kRowMajor, bytes, "a")[0];
  };
  EXPECT_EQ(first(Type::kI8, BytesOf(int8_t{-3})), -3);
  EXPECT_EQ(first(Type::kU8, BytesOf(uint8_t{253})), 253);
  EXPECT_EQ(first(Type::kI16, BytesOf(int16_t{-300})), -300);
  EXPECT_EQ(first(Type::kU16, BytesOf(uint16_t{65000})), 65000);
  EXPECT_EQ(first(Type::kI32, BytesOf(int32_t{-70000})), -70000);
  EXPECT_EQ(first(Type::kU32, BytesOf(uint32_t{4000000000})), 4000000000);
  EXPECT_EQ(first(Type::kI64, BytesOf(int64_t{-5000000000})), -5000000000);
  EXPECT_EQ(first(Type::kU64, BytesOf(uint64_t{5000000000})), 5000000000);
  EXPECT_EQ(first(Type::kF32, BytesOf(1.5f)), 1.5);
  EXPECT_EQ(first(Type::kF64, BytesOf(1e300)), 1e300);
}

TEST(NumberArray, ColumnMajorIsIndexedLikeRowMajor) {
  // [[0, 1, 2], [3, 4, 5]] column by column.
  const NumberArray array(Type::kF32, {2, 3}, Order::kColumnMajor, BytesOf<float>({0, 3, 1, 4, 2, 5}), "a");
  for (int k = 0; k < 6; ++k) EXPECT_EQ(array[k], k);
  const NumberArray transposed = array.Transposed();
  EXPECT_EQ(transposed.shape(), (std::vector<int64_t>{3, 2}));
  EXPECT_EQ(transposed[1], 3);
  EXPECT_EQ(transposed[4], 2);
}

TEST(NumberArray, MatrixIsAReshape) {
  const NumberArray array = Floats({2, 1, 3}, {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(array.Matrix(2, -1), (Eigen::MatrixXf(2, 3) << 0, 1, 2, 3, 4, 5).finished());
  EXPECT_EQ(array.Matrix(-1, 2).rows(), 3);
  EXPECT_EQ(array.Vector(6)[5], 5);
  ExpectError([&] { array.Matrix(4, -1); }, "m: a has the shape (2, 1, 3), expected 4 x 1");
  ExpectError([&] { array.Vector(5); }, "expected 5 x 1");
  ExpectError([&] { Floats({1}, {std::numeric_limits<float>::infinity()}).Vector(); }, "not finite");
}

TEST(NumberArray, PointsAreRowsOrInterleaved) {
  for (const auto& shape : {std::vector<int64_t>{2, 3}, {6}, {6, 1}, {1, 6}})
    EXPECT_EQ(Floats(shape, {0, 1, 2, 3, 4, 5}).Points()(1, 2), 5);
  ExpectError([] { Floats({3, 2}, {0, 1, 2, 3, 4, 5}).Points(); }, "expected V x 3 or 3V");
  ExpectError([] { Floats({4}, {0, 1, 2, 3}).Points(); }, "expected V x 3 or 3V");
}

TEST(NumberArray, PolygonsAreCountedFromTheirFirst) {
  const NumberArray quads(Type::kI32, {1, 4}, Order::kRowMajor, BytesOf<int32_t>({1, 2, 3, 4}), "q");
  const geometry::PolygonMesh mesh = quads.Polygons(1, geometry::Points::Zero(4, 3));
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 4}));
  ExpectError([&] { quads.Polygons(0, geometry::Points::Zero(4, 3)); }, "corner 4, expected a whole number in [0, 4)");
  ExpectError([&] { quads.Polygons(2, geometry::Points::Zero(4, 3)); }, "corner 1");
  ExpectError([&] { Floats({1, 3}, {0, 1, 1.5}).Polygons(0, geometry::Points::Zero(4, 3)); }, "corner 1.5");
  ExpectError([&] { quads.Transposed().Polygons(1, geometry::Points::Zero(4, 3)); }, "expected F x 3 or F x 4");
}

TEST(NumberArray, SizesThatDisagreeOrOverflowAreRefused) {
  ExpectError([] { Floats({3}, {0, 1}); }, "m: a: 8 bytes, its shape (3) needs 12");
  ExpectError([] { Floats({-1}, {}); }, "impossible shape");
  ExpectError([] { Floats({int64_t{1} << 40, int64_t{1} << 40}, {}); }, "impossible shape");
  ExpectError([] { Floats({1}, {0})[1]; }, "element 1 of 1");
}

TEST(NumberArray, MissingArraysAreNamedWithThoseOfTheFile) {
  const NumberArrays arrays = {{"f", Floats({1}, {0})}};
  EXPECT_EQ(ArrayOf(arrays, "f", "m.npz").size(), 1);
  ExpectError([&] { ArrayOf(arrays, "g", "m.npz"); }, "m.npz has no array 'g'; it has: f");
}

}  // namespace
}  // namespace daumier::faces
