#include "fitting/stroke_matches.h"

#include <gtest/gtest.h>

namespace daumier::fitting {
namespace {

using faces::LineLabel;

LabelledStroke StraightStroke(std::array<float, 2> from, std::array<float, 2> to, LineLabel label) {
  return {{from, to}, {label, label}};
}

/// Vertices 0 .. 3 are a square's corners, 4 and 5 a line from (0, 10) to (10, 10).
Eigen::MatrixX2d SquareAndLine() {
  Eigen::MatrixX2d points(6, 2);
  points << 0, 0, 4, 0, 4, 4, 0, 4, 0, 10, 10, 10;
  return points;
}
const LabelCurve kSquareBrow{LineLabel::kBrow, {0, 1, 2, 3, 0}, true};
const LabelCurve kBorderCurve{LineLabel::kSilhouette, {4, 5}};

TEST(StrokeSamples, LieAStepApartOnStrokesThatShowTheFace) {
  LabelledDrawing drawing;
  drawing.strokes = {StraightStroke({0, 0}, {10, 0}, LineLabel::kNose),
                     StraightStroke({0, 5}, {10, 5}, LineLabel::kHair),
                     StraightStroke({0, 9}, {4, 9}, LineLabel::kUpperLip)};
  const auto samples = SampleStrokes(drawing, 2, 100);
  ASSERT_EQ(samples.size(), 7u);
  EXPECT_TRUE(samples[0].position.isApprox(Eigen::Vector2d(1, 0)));
  EXPECT_TRUE(samples[4].position.isApprox(Eigen::Vector2d(9, 0)));
  EXPECT_TRUE(samples[5].position.isApprox(Eigen::Vector2d(1, 9)));
  EXPECT_EQ(samples[5].label, LineLabel::kUpperLip);
  EXPECT_LE(SampleStrokes(drawing, 0.01, 7).size(), 7u);
  EXPECT_TRUE(SampleStrokes({}, 1, 7).empty());
}

TEST(StrokeMatches, AreTheNearestPlacesOfTheSameLabelAlongTheirNormals) {
  const std::vector<StrokeSample> samples = {{{3, 12}, {1, 0}, LineLabel::kSilhouette},
                                             {{3, 12}, {1, 0}, LineLabel::kUpperLip}};
  const auto matches = MatchStrokes(samples, {kSquareBrow, kBorderCurve}, SquareAndLine(), {.reach = 5});
  ASSERT_EQ(matches.size(), 1u);
  EXPECT_EQ(matches[0].place.from, 4);
  EXPECT_DOUBLE_EQ(matches[0].place.share, 0.3);
  EXPECT_DOUBLE_EQ(std::abs(matches[0].normal.y()), 1);
  EXPECT_TRUE(matches[0].target.isApprox(Eigen::Vector2d(3, 12)));
}

TEST(StrokeMatches, EndAtTheReachAtOtherDirectionsAndAtEndsOfCurves) {
  const auto matched = [](const Eigen::Vector2d& position, const Eigen::Vector2d& direction) {
    return MatchStrokes({{position, direction, LineLabel::kSilhouette}}, {kBorderCurve}, SquareAndLine(), {.reach = 5})
        .size();
  };
  EXPECT_EQ(matched({3, 14.9}, {1, 0}), 1u);
  EXPECT_EQ(matched({3, 15.1}, {1, 0}), 0u);
  EXPECT_EQ(matched({3, 12}, {0, 1}), 0u);
  EXPECT_EQ(matched({-1, 12}, {1, 0}), 0u);
}

TEST(StrokeMatches, LeaveLinesWithinABrow) {
  const auto matched = [](double y) {
    return MatchStrokes({{{2, y}, {1, 0}, LineLabel::kBrow}}, {kSquareBrow}, SquareAndLine(), {.reach = 5}).size();
  };
  EXPECT_EQ(matched(2), 0u);
  EXPECT_EQ(matched(5), 1u);
}

TEST(StrokeMatches, OfAClosedEyeAreOnItsLowerLid) {
  Eigen::MatrixX2d points(4, 2);
  points << 0, 0, 10, 0, 0, 4, 10, 4;
  std::vector<LabelCurve> lids = {{LineLabel::kUpperLid, {0, 1}}, {LineLabel::kLowerLid, {2, 3}}};
  const std::vector<StrokeSample> sample = {{{5, 1}, {1, 0}, LineLabel::kUpperLid}};
  EXPECT_EQ(MatchStrokes(sample, lids, points, {}).at(0).place.from, 0);
  EXPECT_EQ(MatchStrokes(sample, lids, points, {.closed_eyes = {true, false}}).at(0).place.from, 2);
  for (LabelCurve& lid : lids) lid.side = 1;
  EXPECT_EQ(MatchStrokes(sample, lids, points, {.closed_eyes = {true, false}}).at(0).place.from, 0);
}

}  // namespace
}  // namespace daumier::fitting
