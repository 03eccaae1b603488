#include "core/error.h"
#include "render/ticks.h"
#include "reports/chart_panel.h"
#include "reports/report.h"

#include <algorithm>
#include <cmath>

namespace daumier::reports {
namespace {

// The chart's own pixels. Two panels above each other share the axis of errors.
constexpr double kWidth = 480.0, kHeight = 420.0;
constexpr double kChartLeft = 58.0, kChartRight = kWidth - 18.0;

constexpr const char* kChartStyle = R"(
.bar { fill: #31688e; } .line { fill: none; stroke: #31688e; stroke-width: 2; }
@media (prefers-color-scheme: dark) { .bar { fill: #6aa9d0; } .line { stroke: #6aa9d0; } }
)";

std::string Bars(const ChartPanel& panel, const ErrorHistogram& histogram) {
  std::string svg;
  for (size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    if (histogram.counts[bin] == 0) continue;
    const double left = panel.x(static_cast<double>(bin) * histogram.bin_width) + 0.5;
    const double right = panel.x(static_cast<double>(bin + 1) * histogram.bin_width) - 0.5;
    const double top = panel.y(histogram.counts[bin]);
    svg += fmt::format("<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", left,
                       top, right - left, panel.bottom - top);
  }
  return svg;
}

/// A stair that rises at each error. Errors within half a pixel share a stair, so that many faces make no long file.
std::string Stairs(const ChartPanel& panel, std::vector<double> errors_mm) {
  std::sort(errors_mm.begin(), errors_mm.end());
  const auto column = [&](size_t i) { return 0.5 * std::round(2.0 * panel.x(errors_mm[i])); };
  std::string path = fmt::format("M{:.1f} {:.1f}", panel.x(0.0), panel.y(0.0));
  for (size_t i = 0; i < errors_mm.size(); ++i) {
    if (i + 1 < errors_mm.size() && column(i + 1) == column(i)) continue;
    const double percent = 100.0 * static_cast<double>(i + 1) / static_cast<double>(errors_mm.size());
    path += fmt::format("H{:.1f}V{:.1f}", column(i), panel.y(percent));
  }
  return fmt::format("<path class=\"line\" d=\"{}H{:.1f}\"/>\n", path, kChartRight);
}

}  // namespace

ErrorHistogram MakeErrorHistogram(const std::vector<double>& errors_mm, int max_bins) {
  DAUMIER_CHECK(!errors_mm.empty(), "a histogram needs at least one error");
  for (const double error : errors_mm)
    DAUMIER_CHECK(std::isfinite(error) && error >= 0.0, "an error of {} mm is no distance", error);
  const double largest = *std::max_element(errors_mm.begin(), errors_mm.end());
  ErrorHistogram histogram;
  histogram.bin_width = largest > 0.0 ? render::NiceStep(largest, max_bins) : 1.0;
  // The slack keeps 0.3 in the bin that begins at 3 * 0.1.
  const auto bin_of = [&](double error) { return static_cast<size_t>(error / histogram.bin_width + 1e-9); };
  histogram.counts.resize(bin_of(largest) + 1);
  for (const double error : errors_mm) ++histogram.counts[bin_of(error)];
  return histogram;
}

std::string ErrorCurveSvg(const std::vector<double>& errors_mm) {
  const ErrorHistogram histogram = MakeErrorHistogram(errors_mm);
  const double x_max = histogram.bin_width * static_cast<double>(histogram.counts.size());
  const int most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
  const ChartPanel bars{kChartLeft, kChartRight, 14.0, 164.0, x_max, static_cast<double>(most)};
  const ChartPanel share{kChartLeft, kChartRight, 224.0, 374.0, x_max, 100.0};
  std::string svg;
  svg += bars.Axes(render::NiceTicks(0.0, most, std::min(4, most)), "mean vertex error (mm)", "faces");
  svg += Bars(bars, histogram) + bars.Baseline();
  svg += share.Axes(render::NiceTicks(0.0, 100.0, 5), "mean vertex error (mm)", "share of faces (%)");
  svg += share.Baseline() + Stairs(share, errors_mm);
  return ChartSvg(kWidth, kHeight, fmt::format("Errors of {} faces", errors_mm.size()), kChartStyle, svg);
}

}  // namespace daumier::reports
