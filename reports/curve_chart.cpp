#include "reports/curve_chart.h"

#include "core/error.h"
#include "reports/chart_panel.h"
#include "reports/html_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace daumier::reports {
namespace {

// The chart's own pixels.
constexpr double kMinWidth = 900.0, kPanelHeight = 300.0, kTop = 36.0, kGap = 84.0;
constexpr double kCurvesLeft = 58.0, kCurvesRight = 620.0, kLegend = 644.0, kLegendLine = 19.0, kLetter = 7.5;
/// Upper end of the axis as a multiple of the largest of the least values.
constexpr double kHeadroom = 1.6;

/// Distinguishable with colour vision deficiency, on white and on black [Tol 2021, bright].
constexpr std::array<const char*, 7> kColours = {"#4477aa", "#ee6677", "#228833", "#ccbb44",
                                                 "#66ccee", "#aa3377", "#888888"};

constexpr const char* kCurveStyle = R"(
.curve { fill: none; stroke-width: 1.8; stroke-linejoin: round; } .title { font-weight: 600; }
)";

double Least(const ChartCurve& curve) {
  return *std::min_element(curve.y.begin(), curve.y.end());
}

void CheckCurves(const std::vector<CurvePanel>& panels) {
  bool any = false;
  for (const CurvePanel& panel : panels) {
    for (const ChartCurve& curve : panel.curves) {
      DAUMIER_CHECK(curve.x.size() == curve.y.size(), "the curve '{}' has {} x and {} y", curve.name, curve.x.size(),
                    curve.y.size());
      for (const std::vector<double>* values : {&curve.x, &curve.y})
        for (const double value : *values)
          DAUMIER_CHECK(std::isfinite(value) && value >= 0.0, "the curve '{}' has a value of {}", curve.name, value);
      any = any || !curve.x.empty();
    }
  }
  DAUMIER_CHECK(any, "a chart of curves needs a point");
}

/// The look of each name, in the order in which names come first.
std::map<std::string, std::string> Strokes(const std::vector<CurvePanel>& panels) {
  std::map<std::string, std::string> strokes;
  for (const CurvePanel& panel : panels) {
    for (const ChartCurve& curve : panel.curves) {
      const size_t index = strokes.size();
      const char* dashes = index < kColours.size() ? "" : " stroke-dasharray=\"6 4\"";
      strokes.try_emplace(curve.name, fmt::format("stroke=\"{}\"{}", kColours[index % kColours.size()], dashes));
    }
  }
  return strokes;
}

std::string CurveSvg(const ChartPanel& panel, const ChartCurve& curve, const std::string& stroke) {
  if (curve.x.empty()) return "";
  std::string path;
  for (size_t i = 0; i < curve.x.size(); ++i)
    path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? "M" : "L", panel.x(curve.x[i]), panel.y(curve.y[i]));
  const size_t best = size_t(std::min_element(curve.y.begin(), curve.y.end()) - curve.y.begin());
  return fmt::format(
      "<path class=\"curve\" {0} d=\"{1}\"/>\n<circle cx=\"{2:.1f}\" cy=\"{3:.1f}\" r=\"3\" fill=\"none\" {0}/>\n",
      stroke, path, panel.x(curve.x[best]), panel.y(curve.y[best]));
}

/// Wide enough for the longest name of the legend.
double Width(const std::map<std::string, std::string>& strokes) {
  size_t longest = 0;
  for (const auto& [name, stroke] : strokes) longest = std::max(longest, name.size());
  return std::max(kMinWidth, kLegend + 30.0 + kLetter * double(longest + 8));
}

/// The names of a panel with the least value of each, the smallest first.
std::string Legend(const CurvePanel& panel, double top, const std::map<std::string, std::string>& strokes) {
  std::map<std::string, double> least;
  for (const ChartCurve& curve : panel.curves) {
    if (curve.x.empty()) continue;
    const auto [entry, is_new] = least.try_emplace(curve.name, Least(curve));
    if (!is_new) entry->second = std::min(entry->second, Least(curve));
  }
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [name, value] : least) order.emplace_back(value, name);
  std::sort(order.begin(), order.end());
  std::string svg;
  double y = top + 8.0;
  for (const auto& [value, name] : order) {
    svg += fmt::format(
        "<path class=\"curve\" {} d=\"M{:.1f} {:.1f}h22\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\">{:.2f}  {}</text>\n",
        strokes.at(name), kLegend, y - 4.5, kLegend + 30.0, y, value, EscapeHtml(name));
    y += kLegendLine;
  }
  return svg;
}

}  // namespace

std::string CurveChartSvg(const std::vector<CurvePanel>& panels, std::string_view title, std::string_view x_label,
                          std::string_view y_label) {
  CheckCurves(panels);
  double x_max = 0.0, largest = 0.0, largest_least = 0.0;
  for (const CurvePanel& panel : panels) {
    for (const ChartCurve& curve : panel.curves) {
      if (curve.x.empty()) continue;
      x_max = std::max(x_max, *std::max_element(curve.x.begin(), curve.x.end()));
      largest = std::max(largest, *std::max_element(curve.y.begin(), curve.y.end()));
      largest_least = std::max(largest_least, Least(curve));
    }
  }
  const double y_max = largest > 0.0 ? render::NiceCeiling(std::min(largest, kHeadroom * largest_least), 6) : 1.0;
  const std::map<std::string, std::string> strokes = Strokes(panels);
  std::string svg;
  double top = kTop;
  for (size_t i = 0; i < panels.size(); ++i) {
    const ChartPanel panel{kCurvesLeft, kCurvesRight, top, top + kPanelHeight, x_max > 0.0 ? x_max : 1.0, y_max};
    svg += fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", kCurvesLeft, top - 14.0,
                       EscapeHtml(panels[i].title));
    svg += panel.Axes(render::NiceTicks(0.0, y_max, 6), x_label, y_label) + panel.Baseline();
    svg += fmt::format(
        "<clipPath id=\"panel{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" "
        "height=\"{4:.1f}\"/></clipPath>\n"
        "<g clip-path=\"url(#panel{0})\">\n",
        i, kCurvesLeft, top, kCurvesRight - kCurvesLeft + 4.0, kPanelHeight + 4.0);
    for (const ChartCurve& curve : panels[i].curves) svg += CurveSvg(panel, curve, strokes.at(curve.name));
    svg += "</g>\n" + Legend(panels[i], top, strokes);
    top += kPanelHeight + kGap;
  }
  return ChartSvg(Width(strokes), top - kGap + 50.0, title, kCurveStyle, svg);
}

}  // namespace daumier::reports
