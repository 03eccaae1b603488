#include "reports/report_page.h"

#include "tests/reports/report_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace daumier::reports {
namespace {

TEST(ReportPage, EscapesAllText) {
  ReportData data = SyntheticReport();
  const std::string evil = R"(<script a="1" b='2'>&)";
  data.title = data.summary = evil;
  data.tables = {{evil, {evil, evil}, {{evil, evil}}}};
  data.facts = {{evil, evil}};
  const std::string page = ReportPage(data);
  EXPECT_EQ(Count(page, "<script"), 0);
  EXPECT_EQ(Count(page, "&lt;script a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;"), 3 + 5 + 2);
}

TEST(ReportPage, HoldsTablesFactsAndPicturesAndNeedsNothingFromElsewhere) {
  const std::string page = ReportPage(SyntheticReport());
  EXPECT_NE(page.find("<tr><th>method</th><th>mm</th></tr>"), std::string::npos);
  EXPECT_NE(page.find("<tr><td>mean face</td><td>4.75</td></tr>"), std::string::npos);
  EXPECT_NE(page.find("<dt>seed</dt><dd>7</dd>"), std::string::npos);
  for (const char* name : {"sheet.png", "mean_error.png", "errors.svg"})
    EXPECT_EQ(Count(page, fmt::format("<img src=\"{}\"", name)), 1) << name;
  EXPECT_EQ(Count(page, "://"), 0);
  EXPECT_EQ(Count(page, "<link") + Count(page, "@import") + Count(page, "url("), 0);
}

TEST(ReportPage, ShowsFurtherCharts) {
  ReportData data = SyntheticReport();
  data.charts = {{"Errors by <strokes>", "strokes.svg", "Fewer is worse.", "<svg/>"}};
  const std::string page = ReportPage(data);
  EXPECT_EQ(Count(page, "<img src=\"strokes.svg\""), 1);
  EXPECT_EQ(Count(page, "Errors by &lt;strokes&gt;") > 0, true);
}

}  // namespace
}  // namespace daumier::reports
