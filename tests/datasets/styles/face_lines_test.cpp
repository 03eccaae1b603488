#include "datasets/styles/face_lines.h"

#include "tests/support/plain_face_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace daumier::datasets {
namespace {

StyledDrawing DrawingOfTwoLines() {
  StyledDrawing drawing;
  drawing.strokes = {{.points = {{100, 100}, {110, 100}}, .labels = {faces::LineLabel::kNose, faces::LineLabel::kNose}},
                     {.points = {{10, 10}, {20, 10}}, .labels = {faces::LineLabel::kHair, faces::LineLabel::kHair}}};
  return drawing;
}

TEST(FaceLines, HairIsLeftOutAndThePoseUndone) {
  StyledDrawing drawing = DrawingOfTwoLines();
  drawing.pose = {.scale = 2, .shift = {300, 40}, .turn_degrees = 90};
  // R(90) p = (-y, x): (x, y) of the sheet comes to (300 - 2 y, 40 + 2 x).
  const auto lines = FaceLines(drawing);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].kind, int(faces::LineLabel::kNose));
  EXPECT_NEAR(lines[0].points.front()[0], 30, 1e-4);
  EXPECT_NEAR(lines[0].points.front()[1], 100, 1e-4);
}

TEST(FaceLines, AnErrorOfTheFrameMovesThem) {
  const auto lines = FaceLines(DrawingOfTwoLines(), {.scale = 1, .shift = {3, -2}});
  EXPECT_NEAR(lines[0].points.front()[0], 103, 1e-4);
  EXPECT_NEAR(lines[0].points.front()[1], 98, 1e-4);
}

TEST(FaceLines, DrawnLinesAreNearThoseOfTheFace) {
  const FaceShape shape = testing::PlainFaceShape();
  StyledShare options;
  options.mislabelled = options.turn_degrees = options.scale = options.shift_px = 0;
  options.styles.doodles = options.styles.page.prefix = 0;
  options.styles.features.head.wrinkles = options.styles.features.head.folds = 0;
  Rng rng = Stream(1, "face lines");
  for (int i = 0; i < 20; ++i) {
    const auto lines = DrawFaceLines(shape, options, rng);
    ASSERT_FALSE(lines.empty());
    double low = 1e9, high = -1e9;
    for (const auto& line : lines) {
      EXPECT_TRUE(ShowsFace(faces::LineLabel(line.kind)));
      for (const auto& point : line.points) {
        low = std::min(low, double(point[0]));
        high = std::max(high, double(point[0]));
      }
    }
    const auto head = shape.head();
    const auto [least, most] =
        std::ranges::minmax_element(head, {}, [](const Eigen::Vector2d& point) { return point.x(); });
    EXPECT_GT(low, least->x() - 25);
    EXPECT_LT(high, most->x() + 25);
  }
}

TEST(FaceLines, MislabelledLinesAreExchanged) {
  StyledShare options;
  options.mislabelled = 1;
  options.styles.features.hair.none = 0;
  Rng rng = Stream(2, "face lines");
  bool has_other = false;
  for (int i = 0; i < 20; ++i)
    for (const auto& line : DrawFaceLines(testing::PlainFaceShape(), options, rng))
      has_other = has_other || !ShowsFace(faces::LineLabel(line.kind));
  EXPECT_TRUE(has_other);
}

}  // namespace
}  // namespace daumier::datasets
