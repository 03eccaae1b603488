#pragma once
#include <string>
#include <vector>

namespace daumier::render {

/// The smallest of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ... with which `range` has at most `max_steps` steps.
/// @throws Error if the range is not positive and finite or max_steps is not positive.
double NiceStep(double range, int max_steps);

/// The least multiple of a nice step that is not below `value`: where an axis from 0 to `value` may end.
/// NiceCeiling(4.6, 5) = 5. @throws Error as NiceStep.
double NiceCeiling(double value, int max_steps);

struct Tick {
  double value = 0.0;
  std::string label;  ///< With as many decimals as the step needs.
};

/// The multiples of a nice step within [low, high], at most max_steps + 1 of them. @throws Error as NiceStep.
std::vector<Tick> NiceTicks(double low, double high, int max_steps);

}  // namespace daumier::render
