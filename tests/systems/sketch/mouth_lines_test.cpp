#include "systems/sketch/mouth_lines.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

using enum faces::LineLabel;

/// A line from corner to corner of a mouth 60 pixels wide whose middle is `depth` below the corners: a parabola.
render::Stroke Arc(double depth, double from = 100, double to = 160) {
  render::Stroke stroke;
  for (int i = 0; i <= 30; ++i) {
    const double t = i / 30.0;
    stroke.points.push_back({float(from + t * (to - from)), float(180 + 4 * t * (1 - t) * depth)});
  }
  return stroke;
}

/// A mouth that a network takes for an open one.
ParsedDrawing MouthOf(const std::vector<std::pair<double, faces::LineLabel>>& arcs) {
  ParsedDrawing drawing;
  for (Eigen::Vector2d& point : drawing.points) point = {130, 100};
  drawing.points[size_t(faces::FacePoint::kMouthRight)] = {100, 180};
  drawing.points[size_t(faces::FacePoint::kMouthLeft)] = {160, 180};
  drawing.points[size_t(faces::FacePoint::kInnerTop)] = {130, 183};
  drawing.points[size_t(faces::FacePoint::kInnerBottom)] = {130, 195};
  drawing.mouth = {0.1, 0.8, 0.1};
  for (const auto& [depth, label] : arcs) {
    drawing.strokes.push_back(Arc(depth));
    drawing.labels.emplace_back(drawing.strokes.back().points.size(), label);
  }
  return drawing;
}

const std::vector<std::pair<double, faces::LineLabel>> kClosedMouth = {
    {-9, kUpperLip}, {3, kInnerMouth}, {15, kLowerLip}};

TEST(MouthLines, OutlineAndMiddleLineAreAClosedMouth) {
  ParsedDrawing drawing = MouthOf(kClosedMouth);
  const auto lines = FindClosedMouthLines(drawing);
  ASSERT_TRUE(lines.has_value());
  EXPECT_NEAR((*lines)[4][0], -9 / 60.0, 1e-3) << "the cut in the middle";
  EXPECT_NEAR((*lines)[4][1], 3 / 60.0, 1e-3);
  EXPECT_NEAR((*lines)[4][2], 15 / 60.0, 1e-3);
  ReadMouthLines(drawing);
  EXPECT_NEAR(drawing.mouth[0], kClosedByLines, 1e-12);
  EXPECT_NEAR(drawing.mouth[0] + drawing.mouth[1] + drawing.mouth[2], 1, 1e-12);
  EXPECT_NEAR(drawing.mouth[1] / drawing.mouth[2], 8, 1e-9) << "as the network has them";
  for (const auto point : {faces::FacePoint::kInnerTop, faces::FacePoint::kInnerBottom})
    EXPECT_LT((drawing.points[size_t(point)] - Eigen::Vector2d(130, 183)).norm(), 0.05);
}

TEST(MouthLines, AnOutlineOfLipsIsAClosedMouth) {
  ParsedDrawing drawing = MouthOf({{-8, kInnerMouth}, {7, kInnerMouth}});
  const auto lines = FindClosedMouthLines(drawing);
  ASSERT_TRUE(lines.has_value());
  EXPECT_NEAR((*lines)[4][1], (-8 + 0.45 * 15) / 60.0, 1e-3);
  ReadMouthLines(drawing);
  EXPECT_NEAR(drawing.mouth[0], kClosedByLines, 1e-12);
  EXPECT_EQ(drawing.labels[0], std::vector(drawing.labels[0].size(), kUpperLip));
  EXPECT_EQ(drawing.labels[1], std::vector(drawing.labels[1].size(), kLowerLip));
}

TEST(MouthLines, AnOutlineInOneStrokeHasTwoLips) {
  ParsedDrawing drawing = MouthOf({{-8, kInnerMouth}});
  const render::Stroke lower = Arc(7);
  drawing.strokes[0].points.insert(drawing.strokes[0].points.end(), lower.points.rbegin(), lower.points.rend());
  drawing.labels[0].assign(62, kInnerMouth);
  ReadMouthLines(drawing);
  for (size_t i = 1; i < 30; ++i) {
    EXPECT_EQ(drawing.labels[0][i], kUpperLip) << i;
    EXPECT_EQ(drawing.labels[0][i + 31], kLowerLip) << i;
  }
}

TEST(MouthLines, OfTwoLinesThatAreNoFlatLipsTheNetworkDecides) {
  for (const auto& [upper, lower] :
       {std::pair(-2.0, 10.0), std::pair(5.0, 15.0), std::pair(-12.0, 12.0), std::pair(-6.0, -2.0)})
    EXPECT_FALSE(FindClosedMouthLines(MouthOf({{upper, kInnerMouth}, {lower, kInnerMouth}})).has_value())
        << "level with the corners, below them, wide open, thin: " << upper << ", " << lower;
}

TEST(MouthLines, EachLineGetsItsLabel) {
  ParsedDrawing drawing = MouthOf({{-9, kInnerMouth}, {3, kInnerMouth}, {15, kInnerMouth}});
  ReadMouthLines(drawing);
  EXPECT_EQ(drawing.labels[0], std::vector(drawing.labels[0].size(), kUpperLip));
  EXPECT_EQ(drawing.labels[1], std::vector(drawing.labels[1].size(), kInnerMouth));
  EXPECT_EQ(drawing.labels[2], std::vector(drawing.labels[2].size(), kLowerLip));
}

TEST(MouthLines, FoundInATurnedAndScaledDrawingToo) {
  ParsedDrawing drawing = MouthOf(kClosedMouth);
  const render::Placement moved{3, {40, -20}, 12};
  drawing.strokes = render::MapToCanvas(drawing.strokes, moved);
  for (Eigen::Vector2d& point : drawing.points) point = render::ToCanvas(moved, point);
  drawing.frame = render::Inverse(moved);
  const auto lines = FindClosedMouthLines(drawing), plain = FindClosedMouthLines(MouthOf(kClosedMouth));
  ASSERT_TRUE(lines.has_value());
  EXPECT_NEAR((*lines)[2][2], (*plain)[2][2], 1e-4);
}

TEST(MouthLines, OfLipsAndAnOpeningTheNetworkDecides) {
  ParsedDrawing drawing = MouthOf({{-9, kUpperLip}, {-2, kInnerMouth}, {8, kInnerMouth}, {15, kLowerLip}});
  const ParsedDrawing before = drawing;
  EXPECT_FALSE(FindClosedMouthLines(drawing).has_value());
  ReadMouthLines(drawing);
  EXPECT_EQ(drawing.mouth, before.mouth);
  EXPECT_EQ(drawing.labels, before.labels);
  EXPECT_EQ(drawing.points, before.points);
}

TEST(MouthLines, AnOpeningWithTeethOrATongueIsNone) {
  EXPECT_FALSE(FindClosedMouthLines(MouthOf({{0.5, kInnerMouth}, {6, kInnerMouth}, {18, kInnerMouth}})).has_value())
      << "its upper edge begins at the corners";
  EXPECT_FALSE(FindClosedMouthLines(MouthOf({{-3, kUpperLip}, {15, kInnerMouth}, {24, kLowerLip}})).has_value())
      << "the middle line hangs below the corners";
  ParsedDrawing teeth = MouthOf(kClosedMouth);
  teeth.mouth = {0, 0.2, 0.8};
  ReadMouthLines(teeth);
  EXPECT_EQ(teeth.mouth[2], 0.8) << "the network finds them";
}

TEST(MouthLines, ALineDrawnTwiceIsOneAndOneLineIsNoOutline) {
  auto arcs = kClosedMouth;
  arcs.push_back({3.5, kInnerMouth});
  EXPECT_TRUE(FindClosedMouthLines(MouthOf(arcs)).has_value());
  EXPECT_FALSE(FindClosedMouthLines(MouthOf({{3, kInnerMouth}})).has_value());
  ParsedDrawing dot = MouthOf(kClosedMouth);
  dot.points[size_t(faces::FacePoint::kMouthLeft)] = dot.points[size_t(faces::FacePoint::kMouthRight)];
  EXPECT_FALSE(FindClosedMouthLines(dot).has_value()) << "a mouth without width";
}

}  // namespace
}  // namespace daumier::sketch
