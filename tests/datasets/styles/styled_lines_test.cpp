#include "datasets/styles/styled_lines.h"

#include <gtest/gtest.h>

namespace daumier::datasets {
namespace {

const Polyline kBox = {{10, -5}, {20, -5}, {20, 5}, {10, 5}};

TEST(LineSheet, CutsWhatIsInsideWithItsAnchors) {
  LineSheet sheet;
  StyledLine& line =
      sheet.Add(DrawnPart::kOutline, faces::LineLabel::kSilhouette, {{0, 0}, {8, 0}, {15, 0}, {25, 0}, {30, 0}},
                {{faces::FacePoint::kChin, 2}, {faces::FacePoint::kContourLeft, 4}});
  line.labels[4] = faces::LineLabel::kNeck;
  sheet.Add(DrawnPart::kMouth, faces::LineLabel::kInnerMouth, {{12, 0}, {14, 0}}, {{faces::FacePoint::kMouthLeft, 0}});
  sheet.CutInside(kBox, 0, sheet.lines.size());
  ASSERT_EQ(sheet.lines.size(), 2u);
  EXPECT_EQ(sheet.lines[0].points, (Polyline{{0, 0}, {8, 0}, {10, 0}}));
  EXPECT_TRUE(sheet.lines[0].anchors.empty());
  EXPECT_EQ(sheet.lines[1].points, (Polyline{{20, 0}, {25, 0}, {30, 0}}));
  ASSERT_EQ(sheet.lines[1].anchors.size(), 1u);
  EXPECT_EQ(sheet.lines[1].anchors[0].point, faces::FacePoint::kContourLeft);
  EXPECT_EQ(sheet.lines[1].anchors[0].index, 2);
  EXPECT_EQ(sheet.lines[1].labels,
            (std::vector<faces::LineLabel>{faces::LineLabel::kSilhouette, faces::LineLabel::kSilhouette,
                                           faces::LineLabel::kNeck}));
}

TEST(LineSheet, LinesAfterTheEndOfACutStay) {
  LineSheet sheet;
  sheet.Add(DrawnPart::kHair, faces::LineLabel::kHair, {{12, 0}, {14, 0}});
  sheet.Add(DrawnPart::kHat, faces::LineLabel::kOther, {{12, 1}, {14, 1}});
  sheet.CutInside(kBox, 0, 1);
  ASSERT_EQ(sheet.lines.size(), 1u);
  EXPECT_EQ(sheet.lines[0].part, DrawnPart::kHat);
}

TEST(LineSheet, AnEyeThatIsCutAwayHasNeitherCentreNorState) {
  LineSheet sheet;
  for (size_t side = 0; side < 2; ++side) {
    const double x = side == 0 ? 15 : 40;
    sheet.Add(EyePart(side), faces::LineLabel::kUpperLid, {{x - 2, 0}, {x + 2, 0}});
    sheet.eyes[side] = faces::EyeState::kOpen;
    sheet.eye_centres[side] = Eigen::Vector2d(x, 0);
  }
  sheet.CutInside(kBox, 0, sheet.lines.size());
  EXPECT_FALSE(sheet.eyes[0].has_value());
  EXPECT_FALSE(sheet.eye_centres[0].has_value());
  EXPECT_TRUE(sheet.eyes[1].has_value());
}

TEST(LineSheet, AreasGoAsWholes) {
  LineSheet sheet;
  sheet.AddMark(DrawnPart::kBrows, faces::LineLabel::kBrow, {{12, 0}, {14, 0}, {14, 2}, {30, 2}}).filled = true;
  sheet.AddMark(DrawnPart::kBrows, faces::LineLabel::kBrow, {{12, 0}, {34, 0}, {34, 2}, {30, 2}}).filled = true;
  sheet.CutInside(kBox, 0, sheet.lines.size());
  ASSERT_EQ(sheet.lines.size(), 1u);
  EXPECT_EQ(sheet.lines[0].points.size(), 4u);
}

TEST(LineSheet, LinesOfOnePointAreLeftOutAndAllIsMoved) {
  LineSheet sheet;
  sheet.Add(DrawnPart::kNose, faces::LineLabel::kNose, {{1, 1}});
  sheet.Add(DrawnPart::kNose, faces::LineLabel::kNose, {{1, 1}, {2, 2}});
  sheet.eye_centres[1] = Eigen::Vector2d(5, 5);
  sheet.Move([](const Eigen::Vector2d& p) { return Eigen::Vector2d(2 * p); });
  ASSERT_EQ(sheet.lines.size(), 1u);
  EXPECT_EQ(sheet.lines[0].points, (Polyline{{2, 2}, {4, 4}}));
  EXPECT_EQ(*sheet.eye_centres[1], Eigen::Vector2d(10, 10));
}

}  // namespace
}  // namespace daumier::datasets
