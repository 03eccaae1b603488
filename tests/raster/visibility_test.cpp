#include "raster/visibility.h"

#include "tests/raster/small_mesh.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::raster {
namespace {

using testing::ExpectError;

template <class T>
class VisibilityOf : public ::testing::Test {};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(VisibilityOf, Numbers);

template <class T>
std::vector<int> VisibleTriangles(const MeshTopology& topology, const std::vector<T>& positions, int height, int width,
                                  Facing facing = Facing::kBoth) {
  Raster<T> raster;
  FindVisibleTriangles(topology, positions.data(), height, width, facing, raster);
  return raster.triangle;
}

/// How often triangles, each alone, cover a pixel.
template <class T>
std::vector<int> Cover(const MeshTopology& topology, const std::vector<T>& positions, int height, int width) {
  std::vector<int> count(size_t(height) * width);
  for (const auto& triangle : topology.triangles) {
    const MeshTopology alone = MakeTopology(triangle, topology.num_vertices);
    const std::vector<int> visible = VisibleTriangles(alone, positions, height, width);
    for (size_t i = 0; i < count.size(); ++i) count[i] += visible[i] == 0 ? 1 : 0;
  }
  return count;
}

/// A fan around (x, y) whose rim is the border of the picture of 12 x 12.
template <class T>
void ExpectFanCoversEachPixelOnce(T x, T y) {
  std::vector<T> positions = {x, y, 0, 1};
  std::vector<int> corners;
  const int rim[8][2] = {{0, 0}, {5, 0}, {12, 0}, {12, 7}, {12, 12}, {3, 12}, {0, 12}, {0, 6}};
  for (int i = 0; i < 8; ++i) {
    positions.insert(positions.end(), {T(rim[i][0]), T(rim[i][1]), T(0), T(1)});
    corners.insert(corners.end(), {0, 1 + i, 1 + (i + 1) % 8});
  }
  for (const int count : Cover(MakeTopology(corners, 9), positions, 12, 12)) ASSERT_EQ(count, 1) << x << " " << y;
}

TYPED_TEST(VisibilityOf, AClosedFanCoversEachPixelOnce) {
  using T = TypeParam;
  const std::vector<T> random = RandomNumbers<T>(200, 7);
  for (size_t i = 0; i < random.size(); i += 2) {
    ExpectFanCoversEachPixelOnce<T>(T(6) + 5 * random[i], T(6) + 5 * random[i + 1]);
  }
  // The middle on pixel centres, on borders of pixels, and next to a centre.
  ExpectFanCoversEachPixelOnce<T>(T(6.5), T(6.5));
  ExpectFanCoversEachPixelOnce<T>(T(6), T(6));
  ExpectFanCoversEachPixelOnce<T>(T(4.5), T(7));
  const T next = std::nextafter(T(6.5), T(9));
  ExpectFanCoversEachPixelOnce<T>(next, T(6.5));
  ExpectFanCoversEachPixelOnce<T>(next, next);
  ExpectFanCoversEachPixelOnce<T>(T(6.5), std::nextafter(T(6.5), T(0)));
}

TYPED_TEST(VisibilityOf, ACentreOnAnEdgeBelongsToTheTriangleForWhichItIsTopOrLeft) {
  using T = TypeParam;
  // A square from centre to centre: (0.5, 0.5) .. (2.5, 2.5) covers rows and columns 0 and 1.
  const std::vector<T> positions = {0.5, 0.5, 0, 1, 2.5, 0.5, 0, 1, 2.5, 2.5, 0, 1, 0.5, 2.5, 0, 1};
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 0, 2, 3}, 4);
  const std::vector<int> visible = VisibleTriangles(topology, positions, 4, 4);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_EQ(visible[4 * row + column] >= 0, row < 2 && column < 2) << row << " " << column;
    }
  }
}

TYPED_TEST(VisibilityOf, TheNearestTriangleIsVisibleAndTheLowerRowAtEqualDepth) {
  using T = TypeParam;
  std::vector<T> positions;
  for (const T depth : {T(5), T(2), T(2)}) {
    positions.insert(positions.end(), {0, 0, depth, 1, 16, 0, depth, 1, 0, 16, depth, 1});
  }
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}, 9);
  for (const int triangle : VisibleTriangles(topology, positions, 4, 4)) EXPECT_EQ(triangle, 1);
}

TYPED_TEST(VisibilityOf, FrontFacesAreCounterClockwiseForTheViewer) {
  using T = TypeParam;
  Camera camera = {.focal = 2, .centre_x = 4, .centre_y = 4, .distance = 4, .height = 8, .width = 8};
  const std::vector<T> points = {-3, -3, 0, 3, -3, 0, 0, 4, 0};
  std::vector<T> positions(12);
  for (const auto projection : {Camera::Projection::kPerspective, Camera::Projection::kOrthographic}) {
    camera.projection = projection;
    Project(camera, 3, points.data(), positions.data());
    Raster<T> raster;
    for (const bool is_front : {true, false}) {
      const std::vector<int> corners = is_front ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 2, 1};
      const MeshTopology topology = MakeTopology(corners, 3);
      FindVisibleTriangles(topology, positions.data(), 8, 8, Facing::kFront, raster);
      EXPECT_EQ(raster.facing[0], is_front ? 1 : -1);
      EXPECT_EQ(raster.triangle[8 * 4 + 4], is_front ? 0 : -1);
      FindVisibleTriangles(topology, positions.data(), 8, 8, Facing::kBoth, raster);
      EXPECT_EQ(raster.triangle[8 * 4 + 4], 0);
    }
  }
}

TYPED_TEST(VisibilityOf, TrianglesBehindTheViewerWithoutAreaAndOutsideOfThePictureAreLeftOut) {
  using T = TypeParam;
  const std::vector<T> positions = {0,   0, 0, 1, 8,  0, 0, 1, 0, 8,   0, 1,   // in front
                                    0,   0, 0, 1, 8,  0, 0, 1, 0, -40, 0, -5,  // reaches behind the viewer
                                    0,   0, 0, 0, 8,  0, 0, 1, 0, 8,   0, 1,   // a corner at the viewer
                                    1,   1, 0, 1, 3,  3, 0, 1, 5, 5,   0, 1,   // a line
                                    2,   2, 0, 1, 2,  2, 0, 1, 2, 2,   0, 1,   // a point
                                    -90, 0, 0, 1, -9, 0, 0, 1, 0, -99, 0, 1};  // outside
  std::vector<int> corners(18);
  for (int i = 0; i < 18; ++i) corners[i] = i;
  for (int triangle = 1; triangle < 6; ++triangle) {
    const MeshTopology alone = MakeTopology(std::span(corners).subspan(3 * triangle, 3), 18);
    for (const int visible : VisibleTriangles(alone, positions, 6, 6)) EXPECT_EQ(visible, -1) << triangle;
  }
  Raster<T> raster;
  FindVisibleTriangles(MakeTopology(corners, 18), positions.data(), 6, 6, Facing::kBoth, raster);
  for (int triangle = 1; triangle < 5; ++triangle) EXPECT_EQ(raster.facing[triangle], 0) << triangle;
  EXPECT_TRUE(std::isnan(raster.vertices[5].x));
}

TYPED_TEST(VisibilityOf, PicturesNarrowerThanFourPixelsAreTheLeftOfWiderOnes) {
  using T = TypeParam;
  const std::vector<T> positions = {0.2, 0.1, 0, 1, 9.3, 3.2, 4, 1, 1.1, 9.7, 2, 1};
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<int> wide = VisibleTriangles(topology, positions, 9, 9);
  for (int width = 1; width < 4; ++width) {
    const std::vector<int> narrow = VisibleTriangles(topology, positions, 9, width);
    for (int row = 0; row < 9; ++row) {
      for (int column = 0; column < width; ++column) EXPECT_EQ(narrow[row * width + column], wide[row * 9 + column]);
    }
  }
}

TYPED_TEST(VisibilityOf, RefusesNumbersThatAreNotFiniteAndPicturesWithoutPixels) {
  using T = TypeParam;
  const MeshTopology topology = MakeTopology(std::vector<int>{0, 1, 2}, 3);
  const std::vector<T> positions = {0, 0, 0, 1, 4, 0, 0, 1, 0, 4, 0, 1};
  for (size_t i = 0; i < positions.size(); ++i) {
    for (const T broken : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
      std::vector<T> changed = positions;
      changed[i] = broken;
      ExpectError([&] { VisibleTriangles(topology, changed, 4, 4); }, "not finite");
    }
  }
  ExpectError([&] { VisibleTriangles(topology, positions, 0, 4); }, "0 x 4");
  ExpectError([&] { VisibleTriangles(topology, positions, 4, kMaxPictureSide + 1); }, "expected sides of 1..");
}

}  // namespace
}  // namespace daumier::raster
