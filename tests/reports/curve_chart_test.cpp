#include "reports/curve_chart.h"

#include "tests/reports/report_fixture.h"
#include "tests/support/expect_error.h"

#include <limits>

namespace daumier::reports {
namespace {

std::string Chart(const std::vector<CurvePanel>& panels) {
  return CurveChartSvg(panels, "training", "steps", "error (mm)");
}

TEST(CurveChart, LegendListsTheMinimumOfEachNameAscending) {
  const std::string svg =
      Chart({{"person", {{"b", {1, 2, 3}, {9, 4.5, 5}}, {"a", {1, 2}, {3, 2.25}}, {"b", {1}, {4}}}}});
  ExpectWellFormed(svg);
  EXPECT_LT(svg.find(">2.25  a<"), svg.find(">4.00  b<"));
  EXPECT_NE(svg.find(">4.00  b<"), std::string::npos);
  EXPECT_EQ(Count(svg, "<circle"), 3);
}

TEST(CurveChart, PanelsShareColoursAndAxis) {
  const std::string svg =
      Chart({{"person", {{"a", {1, 10}, {3, 2}}}}, {"random", {{"b", {5}, {1}}, {"a", {1, 2}, {3, 2}}}}});
  ExpectWellFormed(svg);
  EXPECT_NE(svg.find("person"), std::string::npos);
  EXPECT_NE(svg.find("random"), std::string::npos);
  EXPECT_EQ(Count(svg, "#4477aa"), 2 * 3) << "path, dot and legend of `a` in both panels";
  EXPECT_EQ(Count(svg, ">10<"), 2) << "the axis of both ends at the last step of all";
}

TEST(CurveChart, SteepBeginningsAreCut) {
  const std::string svg = Chart({{"person", {{"a", {1, 2, 3}, {1000, 4, 3}}}}});
  EXPECT_EQ(svg.find(">1000<"), std::string::npos);
  EXPECT_NE(svg.find(">5<"), std::string::npos);
  EXPECT_NE(svg.find("clip-path"), std::string::npos);
}

TEST(CurveChart, LongNamesMakeItWider) {
  const std::string name(60, 'm');
  EXPECT_NE(Chart({{"p", {{"a", {1}, {1}}}}}).find("viewBox=\"0 0 900 "), std::string::npos);
  EXPECT_NE(Chart({{"p", {{name, {1}, {1}}}}}).find("viewBox=\"0 0 1184 "), std::string::npos);
}

TEST(CurveChart, EscapesNames) {
  EXPECT_NE(Chart({{"<p>", {{"<a>", {1}, {1}}}}}).find("&lt;a&gt;"), std::string::npos);
}

TEST(CurveChart, RefusesWhatIsNoCurve) {
  testing::ExpectError([] { Chart({}); }, "needs a point");
  testing::ExpectError([] { Chart({{"p", {{"a", {}, {}}}}}); }, "needs a point");
  testing::ExpectError([] { Chart({{"p", {{"a", {1, 2}, {1}}}}}); }, "has 2 x and 1 y");
  testing::ExpectError([] { Chart({{"p", {{"a", {1}, {std::numeric_limits<double>::quiet_NaN()}}}}}); }, "nan");
}

}  // namespace
}  // namespace daumier::reports
