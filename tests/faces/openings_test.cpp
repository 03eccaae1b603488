#include "faces/openings.h"

#include "core/error.h"
#include "tests/support/synthetic_face.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace daumier::faces {
namespace {

/// An upper path along y = 1 from x = 0 to 4, and a lower one along y = 0 with three vertices.
struct TwoPaths {
  Opening opening{{0, 1, 2}, {3, 4, 5}, {}};
  geometry::Points points{{0, 1, 0}, {2, 1, 0}, {4, 1, 0}, {0, 0, 0}, {1, 0, 0}, {4, 0, 0}};
};

TEST(MeanGap, IsTheMeanHeightBetweenPairs) {
  TwoPaths face;
  face.opening.pairs = {{0, 3}, {1, 4}};
  face.points(1, 1) = -0.5;
  EXPECT_NEAR(MeanGap(face.opening, face.points), (1.0 - 0.5) / 2, 1e-12);
  face.opening.pairs.clear();
  EXPECT_THROW(MeanGap(face.opening, face.points), Error);
}

TEST(CrossingDepth, IsZeroWhileTheSidesAreApartOrTouch) {
  TwoPaths face;
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0);
  face.points(4, 1) = 1;
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0);
}

TEST(CrossingDepth, IsTheHeightOfALowerVertexAboveTheUpperPath) {
  TwoPaths face;
  face.points(4, 1) = 1.25;
  EXPECT_NEAR(CrossingDepth(face.opening, face.points), 0.25, 1e-12);
  face.points(1, 1) = 1.5;  // The upper path is at 1.25 where x is 1.
  EXPECT_NEAR(CrossingDepth(face.opening, face.points), 0, 1e-12);
}

TEST(CrossingDepth, IsTheDepthOfAnUpperVertexBelowTheLowerPath) {
  TwoPaths face;
  face.points(1, 1) = -0.5;
  EXPECT_NEAR(CrossingDepth(face.opening, face.points), 0.5, 1e-12);
}

TEST(CrossingDepth, IgnoresVerticesBeyondTheOtherPathsEnds) {
  TwoPaths face;
  face.points.row(5) << 5, 3, 0;
  face.points.row(4) << 4.5, 3, 0;
  face.points.row(3) << 4.2, 3, 0;
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0);
}

TEST(CrossingDepth, TakesTheHighestPlaceOfAVerticalPart) {
  TwoPaths face;
  face.points.row(1) << 0, 3, 0;  // Straight up from (0, 1), then down to (4, 1).
  face.points.row(3) << 0, 2, 0;
  face.points.row(4) << 0, 1.5, 0;
  face.points.row(5) << 4, 0.5, 0;
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0.5) << "(0, 1) lies below (0, 1.5), (0, 2) not above (0, 3)";
}

TEST(CrossingDepth, ComparesPairs) {
  TwoPaths face;
  face.opening = {{}, {}, {{0, 3}, {2, 5}}};
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0);
  face.points(5, 1) = 1.125;
  EXPECT_EQ(CrossingDepth(face.opening, face.points), 0.125);
}

TEST(FindOpenings, LipsAndLidsOfTheSyntheticFaceHaveTheirSides) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceOpenings openings = FindOpenings(face);
  ASSERT_EQ(openings.lids.size(), 2u);
  EXPECT_EQ(openings.lips.pairs.size(), 3u);
  for (const Opening* opening : {&openings.lips, &openings.lids[0], &openings.lids[1]}) {
    ASSERT_GE(opening->upper.size(), 3u);
    ASSERT_GE(opening->lower.size(), 3u);
    EXPECT_EQ(opening->upper.front(), opening->lower.front()) << "the right corner";
    EXPECT_EQ(opening->upper.back(), opening->lower.back()) << "the left corner";
    EXPECT_LT(face.neutral(opening->upper.front(), 0), face.neutral(opening->upper.back(), 0));
    EXPECT_GT(face.neutral(opening->upper, Eigen::all).col(1).mean(),
              face.neutral(opening->lower, Eigen::all).col(1).mean());
    EXPECT_EQ(CrossingDepth(*opening, face.neutral), 0);
  }
  EXPECT_LT(face.neutral(openings.lids[0].upper.front(), 0), face.neutral(openings.lids[1].upper.front(), 0));
}

TEST(FindOpenings, AFaceUpsideDownHasCrossedLipsAndLids) {
  const FaceTemplate face = testing::SyntheticFace();
  const FaceOpenings openings = FindOpenings(face);
  geometry::Points upside_down = face.neutral;
  upside_down.col(1) *= -1;
  for (const Opening* opening : {&openings.lips, &openings.lids[0], &openings.lids[1]})
    EXPECT_GT(CrossingDepth(*opening, upside_down), 0.1);
}

}  // namespace
}  // namespace daumier::faces
