#include "geometry/surface_matcher.h"

#include "tests/geometry/shapes.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::geometry {
namespace {

const Vector3 kUp(0, 0, 1);

TEST(SurfaceMatcher, MatchesTheClosestPoint) {
  const SurfaceMatcher matcher(testing::FlatSheet(4));
  const auto match = matcher.Match({0.4, 0.3, 0.2}, kUp, {.distance = 1});
  ASSERT_TRUE(match);
  EXPECT_LT((match->position - Vector3(0.4, 0.3, 0)).norm(), 1e-12);
  EXPECT_NEAR(match->distance, 0.2, 1e-12);
}

TEST(SurfaceMatcher, RefusesWhatIsFarOrFacesElsewhere) {
  const SurfaceMatcher matcher(testing::FlatSheet(4));
  const Vector3 point(0.4, 0.3, 0.2);
  EXPECT_FALSE(matcher.Match(point, kUp, {.distance = 0.19}));
  EXPECT_FALSE(matcher.Match(point, -kUp, {}));
  const Vector3 tilted(std::sin(0.7), 0, std::cos(0.7));  // 40.1 degrees
  EXPECT_FALSE(matcher.Match(point, tilted, {.angle_degrees = 40}));
  EXPECT_TRUE(matcher.Match(point, tilted, {.angle_degrees = 41}));
}

TEST(SurfaceMatcher, RefusesTheBorderOfASurfaceThatHasOne) {
  const SurfaceMatcher sheet(testing::FlatSheet(4));
  EXPECT_FALSE(sheet.Match({0.4, -0.01, 0}, kUp, {}));    // Past an edge of the border.
  EXPECT_FALSE(sheet.Match({-1e-3, -1e-3, 0}, kUp, {}));  // Past a corner of it.
  EXPECT_TRUE(sheet.Match({0.25, 0.25, 0.1}, kUp, {}));   // Over a vertex inside.
  const SurfaceMatcher sphere(testing::Sphere(1, 2));
  EXPECT_TRUE(sphere.Match({0, 0, 1.5}, kUp, {}));
}

TEST(SurfaceMatcher, RefusesWhatIsNoSurface) {
  testing::ExpectError([] { SurfaceMatcher({}); }, "at least one triangle");
}

}  // namespace
}  // namespace daumier::geometry
