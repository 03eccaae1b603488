#pragma once
#include "render/ticks.h"

#include <string>
#include <string_view>
#include <vector>

namespace daumier::reports {

/// A panel of an SVG chart, in the chart's own pixels; both axes begin at 0.
struct ChartPanel {
  double left, right, top, bottom;
  double x_max, y_max;

  /// Position of a value on the panel.
  double x(double value) const { return left + (right - left) * value / x_max; }
  double y(double value) const { return bottom - (bottom - top) * value / y_max; }

  /// Grid lines with labels, and what the two axes mean. The labels need 58 pixels on the left and 46 below.
  std::string Axes(const std::vector<render::Tick>& y_ticks, std::string_view x_label, std::string_view y_label) const;
  std::string Baseline() const;
};

/// A whole SVG document of `content` with a light and a dark look. `style` is further CSS; classes `paper`, `grid` and
/// `axis` and the look of text are defined here.
std::string ChartSvg(double width, double height, std::string_view title, std::string_view style,
                     std::string_view content);

}  // namespace daumier::reports
