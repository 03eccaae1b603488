#include "systems/sketch/pen_line.h"

#include "core/error.h"

#include <algorithm>

namespace daumier::sketch {

PenLine Reversed(const PenLine& line) {
  return {datasets::Reversed(line.points), {line.widths.rbegin(), line.widths.rend()}};
}

PenLine Joined(const PenLine& first, const PenLine& second) {
  PenLine joined{datasets::Joined(first.points, second.points), first.widths};
  joined.widths.insert(joined.widths.end(), second.widths.begin(), second.widths.end());
  return joined;
}

PenLine Densified(const PenLine& line, double step) {
  const CanvasPoints& points = line.points;
  DAUMIER_CHECK(!points.empty(), "a line has no point");
  PenLine dense{{points.front()}, {}};
  const bool has_widths = !line.widths.empty();
  if (has_widths) dense.widths.push_back(line.widths.front());
  for (size_t i = 1; i < points.size(); ++i) {
    const int count = int((points[i] - points[i - 1]).norm() / step) + 1;
    for (int k = 1; k <= count; ++k) {
      const double share = double(k) / count;
      dense.points.push_back(points[i - 1] + share * (points[i] - points[i - 1]));
      if (has_widths) dense.widths.push_back(line.widths[i - 1] + share * (line.widths[i] - line.widths[i - 1]));
    }
  }
  return dense;
}

double WidthAtShare(const PenLine& line, double share) {
  if (line.widths.empty()) return 0;
  const std::vector<double> arcs = datasets::ArcLengths(line.points);
  const double at = share * arcs.back();
  const auto next = size_t(std::ranges::upper_bound(arcs, at) - arcs.begin());
  if (next == 0 || next == arcs.size()) return next == 0 ? line.widths.front() : line.widths.back();
  const double part = (at - arcs[next - 1]) / (arcs[next] - arcs[next - 1]);
  return line.widths[next - 1] + part * (line.widths[next] - line.widths[next - 1]);
}

}  // namespace daumier::sketch
