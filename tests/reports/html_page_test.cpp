#include "reports/html_page.h"

#include "tests/reports/report_fixture.h"

namespace daumier::reports {
namespace {

TEST(HtmlPage, EscapesAllText) {
  const std::string evil = R"(<script a="1" b='2'>&)";
  const std::string page =
      PageHtml({evil, evil, {{evil, {evil, evil}, {{evil, evil}}}}, {{evil, evil, evil}}, {{evil, evil}}});
  EXPECT_EQ(Count(page, "<script"), 0);
  EXPECT_EQ(Count(page, "&lt;script a=&quot;1&quot; b=&#39;2&#39;&gt;&amp;"), 3 + 5 + 5 + 2);
}

TEST(HtmlPage, ShowsWhatItIsGivenInOrderAndNothingElse) {
  const std::string page =
      PageHtml({"title", "summary", {}, {{"curves", "a.svg", "below"}, {"sheet", "b.png", "too"}}, {}});
  EXPECT_LT(page.find("a.svg"), page.find("b.png"));
  EXPECT_EQ(Count(page, "<img"), 2);
  EXPECT_EQ(Count(page, "<table") + Count(page, "<dl>"), 0);
}

}  // namespace
}  // namespace daumier::reports
