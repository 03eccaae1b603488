#include "systems/sketch/gesture_metrics.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(GestureColumns, HaveTheErrorFirstAndAllInPercent) {
  EXPECT_EQ(GestureColumns().front().key, "error");
  for (const reports::Metric& column : GestureColumns()) EXPECT_EQ(column.unit, "%");
  for (const reports::Metric& column : GestureSummaryColumns())
    EXPECT_TRUE(reports::FindColumn(GestureColumns(), column.key).has_value());
}

}  // namespace
}  // namespace daumier::sketch
