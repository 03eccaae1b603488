#include "fitting/label_curves.h"

#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::fitting {
namespace {

using faces::LineLabel;

std::vector<LabelCurve> CurvesOf(const faces::FaceTemplate& face) {
  return FindLabelCurves(face, faces::FindFacePoints(face));
}

int CountOf(const std::vector<LabelCurve>& curves, LineLabel label) {
  return int(std::count_if(curves.begin(), curves.end(), [&](const LabelCurve& c) { return c.label == label; }));
}

TEST(LabelCurves, AreThoseThatLinesOfDrawingsShow) {
  const auto curves = CurvesOf(testing::SyntheticFace());
  for (const auto label : {LineLabel::kUpperLid, LineLabel::kLowerLid, LineLabel::kBrow, LineLabel::kEar})
    EXPECT_EQ(CountOf(curves, label), 2) << faces::kLineLabelNames[size_t(label)];
  for (const auto label : {LineLabel::kUpperLip, LineLabel::kLowerLip})
    EXPECT_EQ(CountOf(curves, label), 1) << faces::kLineLabelNames[size_t(label)];
  EXPECT_EQ(CountOf(curves, LineLabel::kInnerMouth), 2);
  EXPECT_GT(CountOf(curves, LineLabel::kSilhouette), 0);
  for (const auto label :
       {LineLabel::kHair, LineLabel::kNeck, LineLabel::kOther, LineLabel::kIris, LineLabel::kWrinkle})
    EXPECT_EQ(CountOf(curves, label), 0) << faces::kLineLabelNames[size_t(label)];
}

TEST(LabelCurves, DivideTheLipsAtTheCorners) {
  const auto face = testing::SyntheticFace();
  const auto& landmarks = face.annotation.landmarks;
  for (const LabelCurve& curve : CurvesOf(face)) {
    if (curve.label != LineLabel::kUpperLip && curve.label != LineLabel::kLowerLip) continue;
    EXPECT_EQ(curve.vertices.front(), landmarks[48]);
    EXPECT_EQ(curve.vertices.back(), landmarks[54]);
    const int middle = landmarks[curve.label == LineLabel::kUpperLip ? 51 : 57];
    EXPECT_NE(std::find(curve.vertices.begin(), curve.vertices.end(), middle), curve.vertices.end());
  }
}

TEST(LabelCurves, OfAPairHaveTheirSides) {
  const auto face = testing::SyntheticFace();
  for (const LabelCurve& curve : CurvesOf(face)) {
    if (curve.label != LineLabel::kUpperLid) continue;
    EXPECT_EQ(face.neutral(curve.vertices.front(), 0) > 0, curve.side == 1);
  }
}

TEST(OpeningPairs, OfASymmetricMouthAreAboveEachOther) {
  const auto face = testing::SyntheticFace();
  const auto openings = FindOpeningPairs(face);
  ASSERT_EQ(openings.size(), 3u);
  const auto& landmarks = face.annotation.landmarks;
  for (const OpeningPairs& opening : openings) {
    ASSERT_EQ(opening.pairs.size(), opening.upper.size());
    EXPECT_LT(face.neutral(opening.upper.front(), 0), face.neutral(opening.upper.back(), 0));
    EXPECT_DOUBLE_EQ(opening.pairs.front().share, 0);
    EXPECT_DOUBLE_EQ(opening.pairs.back().share, 1);
    for (const GapPair& pair : opening.pairs) {
      const double x =
          (1 - pair.lower.share) * face.neutral(pair.lower.from, 0) + pair.lower.share * face.neutral(pair.lower.to, 0);
      EXPECT_NEAR(face.neutral(pair.upper, 0), x, 0.35);
      if (pair.upper != landmarks[62]) continue;
      EXPECT_EQ(pair.lower.share < 0.5 ? pair.lower.from : pair.lower.to, landmarks[66]);
    }
  }
}

TEST(OpeningPairs, AreLeftOutWithoutCurves) {
  auto face = testing::SyntheticFace();
  face.annotation.curves.clear();
  EXPECT_TRUE(FindOpeningPairs(face).empty());
  EXPECT_EQ(CurvesOf(face).size(), 2u) << "the contours have landmarks";
}

}  // namespace
}  // namespace daumier::fitting
