#include "datasets/build/sketch_measures.h"

#include "datasets/build/sketch_views.h"
#include "datasets/styles/polylines.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace daumier::datasets {
namespace {

const faces::FaceTemplate& SyntheticHead() {
  static const faces::FaceTemplate face = testing::SyntheticFace();
  return face;
}

render::Camera TurnedBy(double degrees) {
  const render::Camera camera = SketchCamera(SyntheticHead(), faces::View::kFrontal, 0.62);
  Rng rng(1);
  const ViewNoise still = {.yaw = 0, .pitch = 0, .roll = 0, .scale = 0, .shift = 0};
  return TurnedViewCamera(camera, {.count = 1, .least = degrees, .greatest = degrees}, still, rng);
}

TEST(HeadAngles, AreThoseOfTheCamera) {
  const render::Camera camera = SketchCamera(SyntheticHead(), faces::View::kFrontal, 0.62);
  const HeadAngles front = HeadAnglesOf(camera);
  EXPECT_NEAR(front.yaw, 0, 1e-9);
  EXPECT_NEAR(front.pitch, 0, 1e-9);
  EXPECT_NEAR(front.roll, 0, 1e-9);
  EXPECT_NEAR(HeadAnglesOf(SketchCamera(SyntheticHead(), faces::View::kSide, 0.62)).yaw, 90, 1e-9);
  EXPECT_NEAR(std::abs(HeadAnglesOf(TurnedBy(30)).yaw), 30, 1e-9);
  // The viewer below sees a face that looks up.
  EXPECT_GT(HeadAnglesOf(render::TurnedCamera({0, 0, 0}, 10, 256, 0, -20)).pitch, 19);
}

TEST(SketchMeasures, YawLooksWhereTheNoseIs) {
  const SketchMeasures measures(SyntheticHead(), {});
  const render::Camera camera = TurnedBy(35);
  const SketchFacts facts = measures.Measure(SyntheticHead().neutral, camera, CurveVisibility::kSeen);
  const double nose = facts.landmarks[30][0] - (facts.landmarks[36][0] + facts.landmarks[45][0]) / 2;
  EXPECT_GT(nose * facts.yaw, 0);
}

TEST(SketchMeasures, TheOutlineIsThatOfTheHeadWithoutItsNeck) {
  const SketchMeasures measures(SyntheticHead(), {});
  const render::Camera camera = SketchCamera(SyntheticHead(), faces::View::kFrontal, 0.62);
  const SketchFacts facts = measures.Measure(SyntheticHead().neutral, camera, CurveVisibility::kAll);
  ASSERT_EQ(facts.outline.size(), size_t(SketchFacts::kOutline));
  const geometry::Points pixels = render::Project(camera, SyntheticHead().neutral);
  EXPECT_NEAR(facts.outline[0][1], pixels.col(1).minCoeff(), 2) << "the crown is on top";
  Polyline outline;
  for (const auto& point : facts.outline) outline.emplace_back(point[0], point[1]);
  outline.push_back(outline.front());
  // Nothing of the skull lies outside by more than the rounding of angles.
  for (const int vertex : measures.skull()) {
    const Eigen::Vector2d pixel(pixels(vertex, 0), pixels(vertex, 1));
    EXPECT_TRUE(IsInside(outline, pixel) || DistanceTo(outline, pixel) < 3) << pixel.transpose();
  }
}

TEST(SketchMeasures, TheSkullHasNoEarsAndNoNeck) {
  const SketchMeasures measures(SyntheticHead(), {});
  const std::vector<int>& skull = measures.skull();
  EXPECT_GT(skull.size(), size_t(SyntheticHead().num_vertices()) / 3);
  for (const char* region : {"ears", "neck_border"})
    for (const int vertex : SyntheticHead().annotation.regions.at(region))
      EXPECT_FALSE(std::binary_search(skull.begin(), skull.end(), vertex)) << region;
}

TEST(SketchMeasures, CurvesBehindTheFaceAreHidden) {
  std::vector<int> vertices;
  std::vector<size_t> offsets = {0};
  for (const char* name : {"ear_left", "ear_right"}) {
    for (const auto& curve : SyntheticHead().annotation.curves)
      if (curve.name == name) vertices.insert(vertices.end(), curve.vertices.begin(), curve.vertices.end());
    offsets.push_back(vertices.size());
  }
  const SketchMeasures measures(SyntheticHead(), vertices);
  const SketchFacts facts = measures.Measure(SyntheticHead().neutral, TurnedBy(50), CurveVisibility::kSeen);
  const auto seen = [&](size_t i) {
    return std::count(facts.visible.begin() + long(offsets[i]), facts.visible.begin() + long(offsets[i + 1]), 1);
  };
  const bool looks_left = facts.yaw < 0;  // Its left side is turned to the viewer.
  EXPECT_EQ(seen(looks_left ? 0 : 1), long(offsets[1]));
  EXPECT_LE(seen(looks_left ? 1 : 0), 1) << "but for an end at the border of the face";
  const SketchFacts all = measures.Measure(SyntheticHead().neutral, TurnedBy(50), CurveVisibility::kAll);
  EXPECT_EQ(std::count(all.visible.begin(), all.visible.end(), 1), long(vertices.size()));
}

TEST(SketchMeasures, GapsAreMillimetresOfTheFace) {
  const SketchMeasures measures(SyntheticHead(), {});
  const SketchFacts facts = measures.Measure(SyntheticHead().neutral, TurnedBy(0), CurveVisibility::kAll);
  const auto y = [&](size_t landmark) {
    return SyntheticHead().neutral(SyntheticHead().annotation.landmarks[landmark], 1);
  };
  const double mm = faces::MillimetresPerCm(SyntheticHead());
  EXPECT_NEAR(facts.gaps_mm[2], mm * (y(61) - y(67) + y(62) - y(66) + y(63) - y(65)) / 3, 1e-3);
  EXPECT_NEAR(facts.gaps_mm[0], mm * (y(37) - y(41) + y(38) - y(40)) / 2, 1e-3);
  EXPECT_NEAR(facts.gaps_mm[0], facts.gaps_mm[1], 1e-3) << "the face is symmetric";
}

}  // namespace
}  // namespace daumier::datasets
