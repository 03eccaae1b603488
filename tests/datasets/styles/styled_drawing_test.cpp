#include "datasets/styles/styled_drawing.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

StyledDrawing ThreeStrokes() {
  StyledDrawing drawing;
  for (int i = 0; i < 3; ++i) {
    const auto y = float(10 * i);
    drawing.strokes.push_back(
        {1.5f, false, {{1, y}, {20, y}}, {faces::LineLabel::kUpperLid, faces::LineLabel::kUpperLid}});
  }
  drawing.points[size_t(faces::FacePoint::kEyeRightOuter)] = {{1, 0}, 1};
  drawing.points[size_t(faces::FacePoint::kChin)] = {{128, 200}, 3};
  drawing.mouth = {faces::MouthState::kTeeth, 2};
  drawing.eyes[0] = {faces::EyeState::kClosed, 1};
  drawing.view = {faces::DrawnView::kThreeQuarterLeft, 3};
  drawing.pose = {1.5, {10, -30}, 20};
  return drawing;
}

TEST(StyledDrawing, FirstStrokesShowWhatTheyCarry) {
  const StyledDrawing all = ThreeStrokes();
  EXPECT_EQ(FirstStrokes(all, 3), all);
  const StyledDrawing two = FirstStrokes(all, 2);
  EXPECT_EQ(two.strokes.size(), 2u);
  EXPECT_TRUE(two.points[size_t(faces::FacePoint::kEyeRightOuter)].is_shown());
  EXPECT_FALSE(two.points[size_t(faces::FacePoint::kChin)].is_shown());
  EXPECT_TRUE(two.mouth.is_shown());
  EXPECT_FALSE(two.view.is_shown());
  EXPECT_FALSE(FirstStrokes(all, 1).mouth.is_shown());
  EXPECT_EQ(FirstStrokes(two, 1), FirstStrokes(all, 1));
  testing::ExpectError([&] { FirstStrokes(all, 4); }, "the first 4 strokes of a drawing of 3");
  testing::ExpectError([&] { FirstStrokes(all, 0); }, "the first 0");
}

TEST(StyledDrawing, MirroredSwapsSidesAndIsItsOwnInverse) {
  const StyledDrawing drawing = ThreeStrokes(), mirrored = Mirrored(drawing);
  EXPECT_EQ(mirrored.points[size_t(faces::FacePoint::kEyeLeftOuter)].value, (std::array<float, 2>{255, 0}));
  EXPECT_FALSE(mirrored.points[size_t(faces::FacePoint::kEyeRightOuter)].is_shown());
  EXPECT_EQ(mirrored.points[size_t(faces::FacePoint::kChin)].value[0], 128);
  EXPECT_EQ(mirrored.eyes[1].value, faces::EyeState::kClosed);
  EXPECT_EQ(mirrored.view.value, faces::DrawnView::kThreeQuarterRight);
  const StyledDrawing back = Mirrored(mirrored);
  EXPECT_EQ(back.strokes, drawing.strokes);
  EXPECT_EQ(back.points, drawing.points);
}

TEST(StyledDrawing, ThePoseOfTheMirrorImageIsThatOfTheMirroredSheet) {
  const StyledDrawing drawing = ThreeStrokes(), mirrored = Mirrored(drawing);
  for (const Eigen::Vector2d& p : {Eigen::Vector2d(0, 0), Eigen::Vector2d(30, 170), Eigen::Vector2d(200, 5)}) {
    const Eigen::Vector2d on_canvas = render::ToCanvas(drawing.pose, p),
                          other = render::ToCanvas(mirrored.pose, {256 - p.x(), p.y()});
    EXPECT_NEAR(other[0], 256 - on_canvas[0], 1e-9);
    EXPECT_NEAR(other[1], on_canvas[1], 1e-9);
  }
}

}  // namespace
}  // namespace daumier::datasets
