#include "render/ticks.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {

double NiceStep(double range, int max_steps) {
  DAUMIER_CHECK(std::isfinite(range) && range > 0.0 && max_steps > 0,
                "an axis over {} with {} steps, expected positive numbers", range, max_steps);
  const double smallest = range / max_steps;
  const double power = std::pow(10.0, std::floor(std::log10(smallest)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= smallest * (1.0 - 1e-12)) return factor * power;
  }
  return 10.0 * power;
}

double NiceCeiling(double value, int max_steps) {
  const double step = NiceStep(value, max_steps);
  return step * std::ceil(value / step - 1e-9);
}

std::vector<Tick> NiceTicks(double low, double high, int max_steps) {
  const double step = NiceStep(high - low, max_steps);
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  std::vector<Tick> ticks;
  const double slack = 1e-9 * step;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; k += 1.0) {
    const double value = k == 0.0 ? 0.0 : k * step;  // No "-0".
    ticks.push_back({value, fmt::format("{:.{}f}", value, decimals)});
  }
  return ticks;
}

}  // namespace daumier::render
