#include "systems/sketch/parsed_face.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace daumier::sketch {
namespace {

using enum faces::LineLabel;
using faces::FacePoint;

/// A line of each label at y = 10, 20, ...; all points at (0, 0) on a sheet of half the canvas's scale.
ParsedDrawing LinesOfLabels(const std::vector<faces::LineLabel>& labels) {
  ParsedDrawing drawing;
  drawing.points.fill(Eigen::Vector2d::Zero());
  drawing.frame.scale = 2;
  float y = 0;
  for (const faces::LineLabel label : labels) {
    y += 10;
    drawing.strokes.push_back({0, {{0, y}, {5, y}}});
    drawing.labels.push_back({label, label});
  }
  return drawing;
}

TEST(LinesOfFace, AreThoseThatShowItOrAll) {
  const auto lines = LinesOfFace(LinesOfLabels({kHair, kNose, kNeck, kBrow}));
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].kind, int(kNose));
  EXPECT_EQ(lines[1].points[0][1], 40);
  EXPECT_EQ(LinesOfFace(LinesOfLabels({kHair, kOther})).size(), 2U);
}

TEST(RefuseProfile, RefusesAProbableOne) {
  ParsedDrawing drawing;
  drawing.view = {0.5, 0, 0, 0.5};
  EXPECT_NO_THROW(RefuseProfile(drawing));
  drawing.view = {0.3, 0, 0, 0.7};
  testing::ExpectError([&] { RefuseProfile(drawing); }, "from the side (probability 0.70)");
}

TEST(CanShow, EachPointHasALabelAndHairShowsNone) {
  for (int i = 0; i < faces::kNumFacePoints; ++i) {
    int num = 0;
    for (int label = 0; label < faces::kNumLineLabels; ++label)
      num += CanShow(faces::LineLabel(label), FacePoint(i)) ? 1 : 0;
    EXPECT_GT(num, 0) << i;
    EXPECT_FALSE(CanShow(kHair, FacePoint(i)));
    for (int label = 0; label < faces::kNumLineLabels; ++label)
      EXPECT_EQ(CanShow(faces::LineLabel(label), FacePoint(i)),
                CanShow(faces::LineLabel(label), faces::MirroredPoint(FacePoint(i))));
  }
}

TEST(SupportOf, FallsWithTheDistanceOnTheCanvas) {
  ParsedDrawing drawing = LinesOfLabels({kNose, kBrow});
  const auto at = [](FacePoint point) { return size_t(point); };
  drawing.points[at(FacePoint::kNoseBottom)] = {5, 12};     // 4 pixels of the canvas.
  drawing.points[at(FacePoint::kNoseWingRight)] = {0, 14};  // 8 pixels: one reach beyond the tolerance.
  drawing.points[at(FacePoint::kBrowLeftInner)] = {0, 10};  // On a line of another label, 20 pixels from its own.
  const auto support = SupportOf(drawing);
  EXPECT_NEAR(support[at(FacePoint::kNoseBottom)], 1, 1e-12);
  EXPECT_NEAR(support[at(FacePoint::kNoseWingRight)], std::exp(-0.5), 1e-12);
  EXPECT_NEAR(support[at(FacePoint::kBrowLeftInner)], std::exp(-8), 1e-12);
  EXPECT_EQ(support[at(FacePoint::kChin)], 0) << "no line can show it";
}

TEST(DrawnParts, AreThoseWhosePointsLinesShow) {
  EXPECT_TRUE(DrawnParts(LinesOfLabels({kHair, kOther})).empty());
  ParsedDrawing drawing = LinesOfLabels({kSilhouette, kIris, kNose, kInnerMouth, kEar});
  drawing.points.fill({1000, 1000});
  const auto at = [&](FacePoint point) -> Eigen::Vector2d& { return drawing.points[size_t(point)]; };
  at(FacePoint::kChin) = {0, 10};
  at(FacePoint::kEyeLeftCentre) = {0, 20};  // One of five points.
  at(FacePoint::kNoseBottom) = {0, 31};
  at(FacePoint::kMouthLeft) = {5, 51};  // On no line of a mouth.
  EXPECT_EQ(DrawnParts(drawing), (std::vector<std::string>{"outline", "nose", "ears"}));
  at(FacePoint::kEyeLeftTop) = {5, 21};
  at(FacePoint::kMouthLeft) = {5, 41};
  at(FacePoint::kMouthRight) = {0, 41};
  EXPECT_EQ(DrawnParts(drawing), (std::vector<std::string>{"outline", "left eye", "nose", "mouth", "ears"}));
}

TEST(ParseWarnings, SayThatNoFaceIsSeenOrThatItWasTurned) {
  ParsedDrawing drawing;
  drawing.confidences.fill(0.9);
  drawing.frame.turn_degrees = 14;
  EXPECT_TRUE(ParseWarnings(drawing).empty());
  drawing.frame.turn_degrees = -178;
  ASSERT_EQ(ParseWarnings(drawing).size(), 1u);
  EXPECT_NE(ParseWarnings(drawing)[0].find("turned by -178 degrees"), std::string::npos);
  drawing.frame.turn_degrees = 361;
  drawing.confidences.fill(0.4);
  ASSERT_EQ(ParseWarnings(drawing).size(), 1u);
  EXPECT_NE(ParseWarnings(drawing)[0].find("a confidence of 0.40"), std::string::npos);
}

}  // namespace
}  // namespace daumier::sketch
