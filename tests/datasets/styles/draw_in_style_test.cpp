#include "datasets/styles/draw_in_style.h"

#include "datasets/styles/polylines.h"
#include "tests/support/from_threads.h"
#include "tests/support/plain_face_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace daumier::datasets {
namespace {

constexpr int kNumDrawings = 150;

StyledDrawing Drawn(uint64_t seed, const StyleOptions& options = {}) {
  Rng rng(seed);
  return DrawInStyle(seed % 3 == 0 ? testing::OpenMouthShape() : testing::PlainFaceShape(), options, rng);
}

bool HasLabel(const StyledStroke& stroke, faces::LineLabel label) {
  return std::find(stroke.labels.begin(), stroke.labels.end(), label) != stroke.labels.end();
}

/// Labels of the strokes on which a point of the face may lie.
std::set<faces::LineLabel> LabelsOf(faces::FacePoint point) {
  using enum faces::FacePoint;
  using enum faces::LineLabel;
  if (point <= kEyeLeftBottom) return {kUpperLid, kLowerLid};
  if (point <= kBrowLeftOuter) return {kBrow};
  if (point <= kNoseWingLeft) return {kNose, kSilhouette};
  if (point <= kInnerBottom) return {kUpperLip, kLowerLip, kInnerMouth};
  return {kSilhouette};
}

double DistanceToLabels(const StyledDrawing& drawing, const std::set<faces::LineLabel>& labels,
                        const std::array<float, 2>& at) {
  double nearest = 1e9;
  for (const StyledStroke& stroke : drawing.strokes) {
    if (std::none_of(labels.begin(), labels.end(), [&](faces::LineLabel label) { return HasLabel(stroke, label); }))
      continue;
    Polyline line;
    for (const auto& p : stroke.points) line.emplace_back(p[0], p[1]);
    nearest = std::min(nearest, DistanceTo(line, {at[0], at[1]}));
  }
  return nearest;
}

TEST(DrawInStyle, EveryPointHasALabelAndLiesOnTheCanvas) {
  for (uint64_t seed = 0; seed < kNumDrawings; ++seed) {
    const StyledDrawing drawing = Drawn(seed);
    ASSERT_FALSE(drawing.strokes.empty());
    for (const StyledStroke& stroke : drawing.strokes) {
      ASSERT_FALSE(stroke.points.empty());
      ASSERT_EQ(stroke.labels.size(), stroke.points.size());
      EXPECT_GT(stroke.width, 0);
      for (const auto& point : stroke.points)
        for (const float x : point) EXPECT_TRUE(x >= 0 && x <= 256) << seed;
    }
  }
}

TEST(DrawInStyle, ShownPointsLieOnTheirStrokes) {
  int num_shown = 0;
  for (uint64_t seed = 0; seed < kNumDrawings; ++seed) {
    const StyledDrawing drawing = Drawn(seed);
    for (int i = 0; i < faces::kNumLandmarkPoints; ++i) {
      const auto& point = drawing.points[size_t(i)];
      if (!point.is_shown()) continue;
      ++num_shown;
      EXPECT_LT(DistanceToLabels(drawing, LabelsOf(faces::FacePoint(i)), point.value), 1e-3)
          << "drawing " << seed << ", " << faces::kFacePointNames[size_t(i)];
    }
  }
  EXPECT_GT(num_shown, 8 * kNumDrawings);
}

TEST(DrawInStyle, AClosedMouthShowsNoOpening) {
  StyleOptions options;
  options.page.prefix = 0;
  int num_closed = 0;
  for (uint64_t seed = 0; seed < kNumDrawings; ++seed) {
    const StyledDrawing drawing = Drawn(seed, options);
    if (!drawing.mouth.is_shown() || drawing.mouth.value != faces::MouthState::kClosed) continue;
    ++num_closed;
    const auto &top = drawing.points[size_t(faces::FacePoint::kInnerTop)],
               &bottom = drawing.points[size_t(faces::FacePoint::kInnerBottom)];
    EXPECT_EQ(top.value, bottom.value);
    EXPECT_EQ(top.is_shown(), bottom.is_shown());
  }
  EXPECT_GT(num_closed, kNumDrawings / 4);
}

TEST(DrawInStyle, AnOpenMouthIsDrawnClosedOnlyWhereTheStylesAllowIt) {
  StyleOptions options;
  options.features.mouth.closed = options.doodle_features.mouth.closed = 0;
  for (uint64_t seed = 0; seed < kNumDrawings; seed += 3) {
    const StyledDrawing drawing = Drawn(seed, options);
    if (drawing.mouth.is_shown()) {
      EXPECT_NE(drawing.mouth.value, faces::MouthState::kClosed) << seed;
    }
  }
}

TEST(DrawInStyle, TheSameSeedGivesTheSameDrawingFromAnyThread) {
  for (const uint64_t seed : {1, 2, 3}) testing::ExpectTheSameFromThreads(3, [&] { return Drawn(seed); });
  EXPECT_NE(Drawn(1), Drawn(4));
}

TEST(DrawInStyle, PrefixesGrow) {
  StyleOptions options;
  options.page.prefix = 0;
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const StyledDrawing all = Drawn(seed, options);
    StyledDrawing before = FirstStrokes(all, 1);
    for (int n = 2; n <= int(all.strokes.size()); ++n) {
      const StyledDrawing next = FirstStrokes(all, n);
      for (size_t i = 0; i < all.points.size(); ++i)
        if (before.points[i].is_shown()) {
          EXPECT_EQ(next.points[i], before.points[i]);
        }
      if (before.mouth.is_shown()) {
        EXPECT_EQ(next.mouth, before.mouth);
      }
      before = next;
    }
    EXPECT_EQ(before, all);
  }
}

TEST(DrawInStyle, PrefixesBeginAtOneStroke) {
  StyleOptions options;
  options.page.prefix = 1;
  size_t fewest = 1000;
  for (uint64_t seed = 0; seed < kNumDrawings; ++seed) fewest = std::min(fewest, Drawn(seed, options).strokes.size());
  EXPECT_EQ(fewest, 1u);
}

TEST(DrawInStyle, ExactDrawingsHaveTheLinesOfTheFaceInTheirPose) {
  StyleOptions options;
  options.doodles = options.cartoons = 0;
  options.exact = 1;
  options.page.prefix = 0;
  for (uint64_t seed = 1; seed < 5; ++seed) {
    Rng rng(seed);
    const FaceShape shape = testing::PlainFaceShape();
    const StyledDrawing drawing = DrawInStyle(shape, options, rng);
    const auto near = [&](faces::FacePoint point, const Eigen::Vector2d& on_sheet) {
      const auto at = render::ToCanvas(drawing.pose, on_sheet);
      const auto& shown = drawing.points[size_t(point)];
      EXPECT_TRUE(shown.is_shown());
      EXPECT_NEAR(shown.value[0], at[0], 0.01);
      EXPECT_NEAR(shown.value[1], at[1], 0.01);
    };
    near(faces::FacePoint::kChin, {128, 195});
    near(faces::FacePoint::kEyeLeftOuter, {161, 120});
    near(faces::FacePoint::kMouthRight, {108, 165});
    EXPECT_EQ(drawing.view.value, faces::DrawnView::kFront);
    for (const StyledStroke& stroke : drawing.strokes) EXPECT_FALSE(HasLabel(stroke, faces::LineLabel::kHair));
  }
}

TEST(DrawInStyle, EveryLabelAndStateOccurs) {
  std::set<faces::LineLabel> labels;
  std::set<faces::MouthState> mouths;
  std::set<faces::EyeState> eyes;
  int num_marks = 0;
  for (uint64_t seed = 0; seed < kNumDrawings; ++seed) {
    const StyledDrawing drawing = Drawn(seed);
    for (const StyledStroke& stroke : drawing.strokes) labels.insert(stroke.labels.begin(), stroke.labels.end());
    if (drawing.mouth.is_shown()) mouths.insert(drawing.mouth.value);
    if (drawing.eyes[0].is_shown()) eyes.insert(drawing.eyes[0].value);
    const bool has_centre = drawing.points[size_t(faces::FacePoint::kEyeRightCentre)].is_shown();
    num_marks += has_centre && !drawing.eyes[0].is_shown() ? 1 : 0;
  }
  EXPECT_EQ(labels.size(), size_t(faces::kNumLineLabels));
  EXPECT_EQ(mouths.size(), size_t(faces::kNumMouthStates));
  EXPECT_EQ(eyes.size(), size_t(faces::kNumEyeStates));
  EXPECT_GT(num_marks, 5);
}

}  // namespace
}  // namespace daumier::datasets
