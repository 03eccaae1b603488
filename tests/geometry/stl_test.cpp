#include "geometry/stl.h"

#include "geometry/closed_surface.h"
#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>

namespace daumier::geometry {
namespace {

float FloatAt(const std::string& bytes, size_t at) {
  float value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

TEST(Stl, HasTheBytesOfTheFormat) {
  const std::string bytes = EncodeStl(testing::EquilateralTriangle(), "a triangle");
  ASSERT_EQ(bytes.size(), 84u + 50);
  EXPECT_EQ(bytes.substr(0, 10), "a triangle");
  EXPECT_EQ(bytes.substr(10, 70), std::string(70, '\0'));
  EXPECT_EQ(bytes.substr(80, 4), std::string("\1\0\0\0", 4));
  const std::array<float, 12> expected = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0.5f, float(std::sqrt(0.75)), 0};
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(FloatAt(bytes, 84 + 4 * i), expected[i]) << i;
  EXPECT_EQ(bytes.substr(132, 2), std::string(2, '\0'));
}

TEST(Stl, IsReadAgain) {
  const TriangleMesh sphere = testing::Sphere(3, 3);
  const TriangleMesh read = DecodeStl(EncodeStl(sphere, "ball"));
  ASSERT_EQ(read.triangles.rows(), sphere.triangles.rows());
  EXPECT_EQ(read.vertices.rows(), sphere.vertices.rows());
  EXPECT_TRUE(IsClosed(read.triangles));
  EXPECT_NEAR(EnclosedVolume(read), EnclosedVolume(sphere), 1e-4);
}

TEST(Stl, RefusesWhatIsNoFile) {
  const TriangleMesh triangle = testing::EquilateralTriangle();
  testing::ExpectError([&] { EncodeStl(triangle, "solid head"); }, "begins with 'solid'");
  testing::ExpectError([&] { EncodeStl(triangle, std::string(81, 'x')); }, "more than 80 bytes");
  TriangleMesh broken = triangle;
  broken.triangles(0, 1) = 3;
  testing::ExpectError([&] { EncodeStl(broken, ""); }, "names a vertex that is not there");
  broken = triangle;
  broken.vertices(1, 1) = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { EncodeStl(broken, ""); }, "vertex 1 is not finite");
  const std::string bytes = EncodeStl(triangle, "");
  testing::ExpectError([&] { DecodeStl(bytes.substr(0, 83)); }, "83 bytes are too few");
  testing::ExpectError([&] { DecodeStl(bytes.substr(0, 133)); }, "of 1 triangles has 133 bytes, expected 134");
  std::string infinite = bytes;
  std::memcpy(infinite.data() + 96, "\0\0\x80\x7f", 4);
  testing::ExpectError([&] { DecodeStl(infinite); }, "triangle 0 has a corner that is not finite");
}

}  // namespace
}  // namespace daumier::geometry
