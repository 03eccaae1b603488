#include "systems/sketch/network_options.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <vector>

namespace daumier::sketch {

void RequireWholeBlocks(const SketchNetworkOptions& options) {
  if (options.has_whole_blocks()) return;
  const int step = options.width_step(), below = options.width / step * step, above = below + step;
  std::vector<int> allowed;
  if (below > 0) allowed.push_back(below);
  if (above <= SketchNetworkOptions::kMaxWidth) allowed.push_back(above);
  throw UsageError(
      fmt::format("network.width={} gives network.trunk=\"{}\" channels that are no multiples of 8, which oneDNN "
                  "computes at a time (expected a multiple of {}): set network.width={}",
                  options.width, options.trunk, step, fmt::join(allowed, " or ")));
}

}  // namespace daumier::sketch
