#pragma once
#include "datasets/styles/drawing_context.h"

#include <gtest/gtest.h>

#include <optional>

/// A face of ellipses and arcs whose places are known, for tests of drawing styles.
namespace daumier::testing {

/// Eyes at (106, 120) and (150, 120), 22 wide; outer corners 66 apart; mouth from (108, 165) to (148, 165); nose base
/// at y = 146; head an ellipse about (128, 130) of half axes 50 and 65, the chin at (128, 195).
inline datasets::FaceShape PlainFaceShape() {
  using namespace datasets;
  using Eigen::Vector2d;
  const auto arc = [](const Vector2d& from, const Vector2d& to, double bulge, int count) {
    Polyline line;
    for (int i = 0; i < count; ++i) {
      const double t = double(i) / (count - 1);
      line.push_back(from + t * (to - from) + Vector2d(0, bulge * 4 * t * (1 - t)));
    }
    return line;
  };
  FaceShape shape;
  shape.unit = 66;
  shape.eyes_middle = {128, 120};
  shape.hairline = {128, 88};
  shape.outline = EllipseArc({128, 130}, 50, 65, 180, 0, FaceShape::kOutlinePoints);
  shape.skull = EllipseArc({128, 130}, 50, 65, 0, -180, FaceShape::kSkullPoints);
  for (size_t side = 0; side < 2; ++side) {
    const double outward = side == 0 ? -1 : 1, x = 128 + outward * 22;
    const Vector2d outer(x + outward * 11, 120), inner(x - outward * 11, 120);
    shape.eyes[side].upper = arc(outer, inner, -5, EyeShape::kPoints);
    shape.eyes[side].lower = arc(outer, inner, 4, EyeShape::kPoints);
    const Vector2d brow_outer(x + outward * 14, 108), brow_inner(x - outward * 12, 107);
    shape.brows[side].upper = arc(brow_outer, brow_inner, -5, BrowShape::kPoints);
    shape.brows[side].lower = arc(brow_outer, brow_inner, -2, BrowShape::kPoints);
    shape.nose.bridges[side] = arc({128 + outward * 6, 114}, {128 + outward * 7, 136}, 0, NoseShape::kBridgePoints);
    shape.nose.wings[side] = Smooth({{128 + outward * 10, 137}, {128 + outward * 13, 142}, {128 + outward * 10, 146}},
                                    NoseShape::kWingPoints);
    shape.ears[side].outer = EllipseArc({128 + outward * 49, 130}, 9, 16, -90, side == 0 ? -270 : 90, 21);
    shape.ears[side].inner = EllipseArc({128 + outward * 50, 130}, 5, 10, -90, side == 0 ? -270 : 90, 9);
  }
  shape.nose.base = arc({118, 146}, {138, 146}, 2, NoseShape::kBasePoints);
  shape.mouth.top = arc({108, 165}, {148, 165}, -5, MouthShape::kPoints);
  shape.mouth.inner_top = shape.mouth.inner_bottom = arc({108, 165}, {148, 165}, 1, MouthShape::kPoints);
  shape.mouth.bottom = arc({108, 165}, {148, 165}, 8, MouthShape::kPoints);
  shape.wrinkles = {{{100, 150}, {97, 158}, {98, 166}}};
  return shape;
}

/// The same face with its mouth open by 12 pixels.
inline datasets::FaceShape OpenMouthShape() {
  datasets::FaceShape shape = PlainFaceShape();
  for (size_t i = 0; i < shape.mouth.inner_bottom.size(); ++i) {
    const double t = double(i) / double(shape.mouth.inner_bottom.size() - 1), down = 12 * 4 * t * (1 - t);
    shape.mouth.inner_bottom[i].y() += down;
    shape.mouth.bottom[i].y() += down;
  }
  shape.mouth.is_open = true;
  return shape;
}

/// All that a part of a drawing is drawn with.
struct PartDrawing {
  datasets::FaceShape shape = PlainFaceShape();
  datasets::FeatureStyles styles = {};
  datasets::DrawingCharacter character = datasets::DrawingCharacter::kCareful;
  Rng rng = Rng(1);
  datasets::LineSheet sheet = {};

  datasets::DrawingContext context() { return {shape, styles, character, rng, sheet}; }
  /// The point of the face on the first line that has it; nothing if none has.
  std::optional<Eigen::Vector2d> At(faces::FacePoint point) const {
    for (const datasets::StyledLine& line : sheet.lines)
      for (const datasets::LineAnchor& anchor : line.anchors)
        if (anchor.point == point) return line.points[size_t(anchor.index)];
    return std::nullopt;
  }
  int NumLines(faces::LineLabel label) const {
    int count = 0;
    for (const datasets::StyledLine& line : sheet.lines) {
      bool has = false;
      for (const faces::LineLabel of_point : line.labels) has = has || of_point == label;
      count += has ? 1 : 0;
    }
    return count;
  }
};

/// Expects of each line a label for each point, and anchors that are points of it.
inline void ExpectWholeLines(const datasets::LineSheet& sheet) {
  for (const datasets::StyledLine& line : sheet.lines) {
    EXPECT_GE(line.points.size(), 2u);
    EXPECT_EQ(line.labels.size(), line.points.size());
    for (const datasets::LineAnchor& anchor : line.anchors) {
      EXPECT_GE(anchor.index, 0);
      EXPECT_LT(anchor.index, int(line.points.size()));
    }
    for (const Eigen::Vector2d& point : line.points) EXPECT_TRUE(point.allFinite());
  }
}

}  // namespace daumier::testing
