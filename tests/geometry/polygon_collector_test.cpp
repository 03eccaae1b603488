#include "geometry/polygon_collector.h"

#include "core/log.h"
#include "tests/support/expect_error.h"
#include "tests/support/warnings.h"

#include <gtest/gtest.h>

#include <limits>

namespace daumier::geometry {
namespace {

constexpr int kNone = PolygonCollector::kNoUv;

TEST(PolygonCollector, KeepsWholePolygonsAndTheirUvWithoutAWarning) {
  PolygonCollector collector;
  collector.Add(std::vector{3, 1, 0}, std::vector{0, 1, 2});
  collector.Add(std::vector{0, 1, 2, 3}, std::vector{2, 1, 0, 3});
  const TextureCoordinates uv = TextureCoordinates::Random(4, 2);
  const PolygonMesh mesh = std::move(collector).Finish(Points::Random(4, 3), uv, "text");
  EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 3, 7}));
  EXPECT_EQ(mesh.corners, (std::vector<int>{3, 1, 0, 0, 1, 2, 3}));
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 1, 2, 2, 1, 0, 3}));
  EXPECT_EQ(mesh.uv, uv);
}

TEST(PolygonCollector, RepeatedVerticesAreKeptOnceAndOneWarningCountsThem) {
  testing::AllowWarnings();
  PolygonCollector collector;
  collector.Add(std::vector{0, 1, 1, 2, 0}, std::vector{0, 1, 2, 3, 4});
  collector.Add(std::vector{2, 2, 1}, std::vector{0, 1, 2});
  collector.Add(std::vector{0, 1}, std::vector{0, 1});
  const int num_warnings = log::NumWarnings();
  const PolygonMesh mesh = std::move(collector).Finish(Points::Random(3, 3), TextureCoordinates::Random(5, 2), "text");
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
  EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 3}));
  EXPECT_EQ(mesh.corners, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 1, 3}));
}

TEST(PolygonCollector, OneWarningCountsAllFlaws) {
  testing::AllowWarnings();
  PolygonCollector collector;
  collector.Add(std::vector{0, 1, 1, 2}, std::vector{0, 1, 1, 2});
  collector.Add(std::vector{0, 1, 3}, std::vector{0, 1, 3});
  collector.Add(std::vector{0, 1}, std::vector{0, 1});
  collector.CountOtherElements(2);
  Points vertices = Points::Random(4, 3);
  vertices(3, 1) = std::numeric_limits<double>::infinity();
  const int num_warnings = log::NumWarnings();
  const PolygonMesh mesh = std::move(collector).Finish(vertices, TextureCoordinates::Random(4, 2), "text");
  EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
  EXPECT_EQ(mesh.offsets, (std::vector<int>{0, 3}));
  EXPECT_EQ(mesh.uv_corners, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(mesh.vertices, vertices) << "no vertex gets another number";
}

TEST(PolygonCollector, RefusesWhatIsNoSurface) {
  PolygonCollector collector;
  collector.Add(std::vector{0, 1}, std::vector{kNone, kNone});
  testing::ExpectError([&] { std::move(collector).Finish(Points::Random(3, 3), {}, "a.obj"); },
                       "a.obj: no polygon is left (found 1 with fewer than three distinct corners and 0");
  testing::ExpectError([] { RefuseCloud("a.ply", 7); }, "a.ply: has points, but no faces: a cloud of points (found 7 ");
  Points vertices = Points::Random(3, 3);
  EXPECT_NO_THROW(CheckFinite(vertices, "a.obj"));
  vertices(2, 0) = std::numeric_limits<double>::quiet_NaN();
  testing::ExpectError([&] { CheckFinite(vertices, "a.obj"); }, "a.obj: the position of vertex 2 (counted from 0)");
}

TEST(PolygonCollector, UvThatACornerLacksIsDropped) {
  testing::AllowWarnings();
  const TextureCoordinates uv =
      (TextureCoordinates(2, 2) << 0, 0, 1, std::numeric_limits<double>::infinity()).finished();
  for (const int row : {kNone, 1}) {
    PolygonCollector collector;
    collector.Add(std::vector{0, 1, 2}, std::vector{0, 0, row});
    const int num_warnings = log::NumWarnings();
    const PolygonMesh mesh = std::move(collector).Finish(Points::Random(3, 3), uv, "text");
    EXPECT_EQ(log::NumWarnings(), num_warnings + 1);
    EXPECT_FALSE(mesh.has_uv());
    EXPECT_TRUE(mesh.uv_corners.empty());
  }
}

TEST(PolygonCollector, UvOfVerticesBecomesThatOfTheirCorners) {
  PolygonCollector collector;
  collector.Add(std::vector{2, 0, 1}, std::vector{kNone, kNone, kNone});
  collector.UseVertexUv();
  const PolygonMesh mesh = std::move(collector).Finish(Points::Random(3, 3), TextureCoordinates::Random(3, 2), "text");
  EXPECT_EQ(mesh.uv_corners, mesh.corners);
  testing::ExpectError([] { PolygonCollector().Add(std::vector{0, 1, 2}, {}); }, "UV of 0 corners, expected 3");
}

}  // namespace
}  // namespace daumier::geometry
