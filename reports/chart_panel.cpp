#include "reports/chart_panel.h"

#include "reports/html_page.h"

#include <fmt/format.h>

namespace daumier::reports {
namespace {

constexpr const char* kAxisStyle = R"(
.paper { fill: #fff; } .grid { stroke: #e4e4e8; } .axis { stroke: #88888f; }
text { fill: #45454c; font: 13px system-ui, sans-serif; }
@media (prefers-color-scheme: dark) {
  .paper { fill: #212126; } .grid { stroke: #34343b; } .axis { stroke: #8a8a92; } text { fill: #c8c8ce; }
})";

}  // namespace

std::string ChartPanel::Axes(const std::vector<render::Tick>& y_ticks, std::string_view x_label,
                             std::string_view y_label) const {
  std::string svg;
  for (const render::Tick& tick : y_ticks) {
    const double row = y(tick.value);
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n", left,
                       right, row);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>\n", left - 7.0, row + 4.5,
                       tick.label);
  }
  for (const render::Tick& tick : render::NiceTicks(0.0, x_max, 8)) {
    svg += fmt::format("<line class=\"axis\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"/>\n",
                       x(tick.value), bottom, bottom + 4.0);
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x(tick.value),
                       bottom + 18.0, tick.label);
  }
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", (left + right) / 2.0,
                     bottom + 35.0, x_label);
  svg += fmt::format("<text transform=\"translate(16 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     (top + bottom) / 2.0, y_label);
  return svg;
}

std::string ChartPanel::Baseline() const {
  return fmt::format("<line class=\"axis\" x1=\"{0:.1f}\" x2=\"{1:.1f}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n", left,
                     right, bottom);
}

std::string ChartSvg(double width, double height, std::string_view title, std::string_view style,
                     std::string_view content) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">\n"
      "<title>{2}</title>\n<style>{3}{4}</style>\n<rect class=\"paper\" width=\"{0}\" height=\"{1}\"/>\n{5}</svg>\n",
      width, height, EscapeHtml(title), kAxisStyle, style, content);
}

}  // namespace daumier::reports
