#include "reports/report_table.h"

#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

const ReportTable kTable{"Errors", {"predictor", "mm"}, {{"network", "2.000"}, {"a longer name", "12.000"}}};

TEST(ReportTable, MarkdownHasAHeaderAndARule) {
  EXPECT_EQ(TableMarkdown(kTable),
            "| predictor | mm |\n"
            "|---|---:|\n"
            "| network | 2.000 |\n"
            "| a longer name | 12.000 |\n");
}

TEST(ReportTable, TextIsAligned) {
  EXPECT_EQ(TableText(kTable),
            "predictor          mm\n"
            "network         2.000\n"
            "a longer name  12.000\n");
}

}  // namespace
}  // namespace daumier::reports
