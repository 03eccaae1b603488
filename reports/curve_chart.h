#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace daumier::reports {

/// Points (x, y) in the order in which they are joined, x and y >= 0. Curves of one name have one colour.
struct ChartCurve {
  std::string name;
  std::vector<double> x, y;
};

struct CurvePanel {
  std::string title;
  std::vector<ChartCurve> curves;
};

/// A chart of a report.
struct ReportChart {
  std::string title, file;  ///< "Errors by strokes", "strokes.svg"
  std::string caption, svg;
};

/// Curves as SVG, a panel below the other, all with the same colours and axis of y. A dot marks the least y of each
/// curve, and the legend lists each curve's minimum, ascending. The axis of y ends a little above the
/// largest of these least values, so that steep beginnings do not flatten the curves; parts above are cut.
/// @throws Error if no curve has a point, the lengths of x and y differ, or a number is negative or not finite.
std::string CurveChartSvg(const std::vector<CurvePanel>& panels, std::string_view title, std::string_view x_label,
                          std::string_view y_label);

}  // namespace daumier::reports
