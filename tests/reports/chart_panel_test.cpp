#include "reports/chart_panel.h"

#include "tests/reports/report_fixture.h"

namespace daumier::reports {
namespace {

TEST(ChartPanel, PlacesValuesByHand) {
  const ChartPanel panel{100, 300, 20, 120, 10, 50};
  EXPECT_EQ(panel.x(0), 100);
  EXPECT_EQ(panel.x(5), 200);
  EXPECT_EQ(panel.y(0), 120);
  EXPECT_EQ(panel.y(50), 20);
}

TEST(ChartPanel, AxesHaveTitlesAndAreWellFormed) {
  const ChartPanel panel{60, 300, 20, 120, 10, 50};
  const std::string svg = ChartSvg(320, 200, "a < b", ".line { stroke: red; }",
                                   panel.Axes(render::NiceTicks(0, 50, 5), "steps", "error (mm)") + panel.Baseline());
  ExpectWellFormed(svg);
  for (const char* part : {">steps<", ">error (mm)<", ">50<", ">10<", "a &lt; b", ".line { stroke: red; }"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace daumier::reports
