#include "gltf/meshopt_codec.h"

#include "tests/support/expect_error.h"

#include <meshoptimizer.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace daumier::gltf {
namespace {

const unsigned char* Data(const std::string& bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// As a reader of the extension decodes it.
std::vector<float> DecodedMultiples(const std::string& encoded, size_t count, size_t columns) {
  std::vector<float> values(count * columns);
  const size_t stride = columns * sizeof(float);
  EXPECT_EQ(meshopt_decodeVertexBuffer(values.data(), count, stride, Data(encoded), encoded.size()), 0);
  meshopt_decodeFilterExp(values.data(), count, stride);
  return values;
}

TEST(RoundToStep, RoundsToTheNearestMultipleAndRefusesWhatHasNone) {
  std::vector<float> values = {0.3f, -0.3f, 0.124f, 0.f, 7};
  RoundToStep(values, -2);
  EXPECT_EQ(values, (std::vector<float>{0.25f, -0.25f, 0.f, 0.f, 7}));
  std::vector<float> large = {3e6f};
  testing::ExpectError([&] { RoundToStep(large, -2); }, "cannot be stored in steps of 2^-2");
  std::vector<float> missing = {std::numeric_limits<float>::quiet_NaN()};
  testing::ExpectError([&] { RoundToStep(missing, -2); }, "cannot be stored");
}

TEST(EncodeMultiples, IsDecodedToTheSameFloats) {
  std::vector<float> values;
  for (int i = 0; i < 3 * 1000; ++i) values.push_back(i % 7 == 0 ? 0 : 0.2f * std::sin(0.01f * float(i)));
  RoundToStep(values, -17);
  const std::string encoded = EncodeMultiples(values, 3, -17);
  EXPECT_EQ(DecodedMultiples(encoded, 1000, 3), values);
  EXPECT_LT(encoded.size(), 3000u * sizeof(float) / 2);
}

TEST(EncodeMultiples, HoldLargeValuesAsWell) {
  std::vector<float> values = {60.5f, -0.25f, 0, 7e5f, -8e5f, 1};
  EXPECT_EQ(DecodedMultiples(EncodeMultiples(values, 3, -2), 2, 3), values);
  values = {0.125f, -0.125f, 0.5f};
  EXPECT_EQ(DecodedMultiples(EncodeMultiples(values, 1, -3), 3, 1), values);
}

TEST(EncodeElements, IsDecodedToTheSameBytes) {
  std::string bytes;
  for (int i = 0; i < 4 * 300; ++i) bytes += char(i * i % 251);
  const std::string encoded = EncodeElements(bytes, 4);
  std::string decoded(bytes.size(), '\0');
  ASSERT_EQ(meshopt_decodeVertexBuffer(decoded.data(), 300, 4, Data(encoded), encoded.size()), 0);
  EXPECT_EQ(decoded, bytes);
}

TEST(EncodeTriangles, KeepsTrianglesAndTheirOrientation) {
  const std::vector<uint32_t> indices = {0, 1, 2, 2, 1, 3, 3, 1, 4, 7, 5, 6};
  const std::string encoded = EncodeTriangles(indices, 8);
  std::vector<uint32_t> decoded(indices.size());
  ASSERT_EQ(meshopt_decodeIndexBuffer(decoded.data(), decoded.size(), sizeof(uint32_t), Data(encoded), encoded.size()),
            0);
  const auto triangles = [](const std::vector<uint32_t>& corners) {
    std::multiset<std::array<uint32_t, 3>> found;  // Each rotated so that its least corner comes first.
    for (size_t i = 0; i < corners.size(); i += 3) {
      std::array<uint32_t, 3> t = {corners[i], corners[i + 1], corners[i + 2]};
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      found.insert(t);
    }
    return found;
  };
  EXPECT_EQ(triangles(decoded), triangles(indices));
}

}  // namespace
}  // namespace daumier::gltf
