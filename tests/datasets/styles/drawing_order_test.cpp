#include "datasets/styles/drawing_order.h"

#include <gtest/gtest.h>

#include <set>

namespace daumier::datasets {
namespace {

TEST(DrawingOrder, PartsStayTogetherAndLinesOfAPartInTheirOrder) {
  std::set<DrawnPart> first_parts;
  for (uint64_t seed = 0; seed < 60; ++seed) {
    LineSheet sheet;
    for (int round = 0; round < 3; ++round)
      for (int part = 0; part < kNumDrawnParts; ++part)
        sheet.Add(DrawnPart(part), faces::LineLabel::kOther, {{double(round), 0}, {1, 1}});
    Rng rng(seed);
    SortAsDrawn(sheet, rng);
    ASSERT_EQ(sheet.lines.size(), size_t(3 * kNumDrawnParts));
    std::set<DrawnPart> seen;
    for (size_t i = 0; i < sheet.lines.size(); ++i) {
      EXPECT_EQ(sheet.lines[i].points[0].x(), double(i % 3));
      EXPECT_EQ(seen.insert(sheet.lines[i].part).second, i % 3 == 0);
    }
    first_parts.insert(sheet.lines.front().part);
  }
  EXPECT_GE(first_parts.size(), 3u) << "drawings begin with several parts";
}

}  // namespace
}  // namespace daumier::datasets
