#include "systems/sketch/network_options.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace daumier::sketch {

const std::vector<TrunkKind>& TrunkKinds() {
  static const std::vector<TrunkKind> rows = {
      {.name = "compact"},
      {.name = "alexnet", .width_step = 24},
      {.name = "residual"},
      {.name = "points", .input = TrunkInput::kPoints, .width_step = 4, .help = "a point network on its strokes"},
      {.name = "shape", .input = TrunkInput::kCurves, .width_step = 1, .help = "its curve coefficients alone"},
  };
  return rows;
}

std::vector<std::string> TrunkNames() {
  std::vector<std::string> names;
  for (const TrunkKind& kind : TrunkKinds()) names.push_back(kind.name);
  return names;
}

const TrunkKind& TrunkNamed(const std::string& name) {
  const auto found = std::ranges::find(TrunkKinds(), name, &TrunkKind::name);
  if (found != TrunkKinds().end()) return *found;
  throw UsageError(fmt::format("there is no network.trunk \"{}\" (expected {})", name, fmt::join(TrunkNames(), ", ")));
}

std::string TrunkHelp() {
  std::string help;
  const std::vector<TrunkKind>& rows = TrunkKinds();
  for (size_t i = 0; i < rows.size(); ++i) {
    const bool goes_with_next = i + 1 < rows.size() && rows[i].help == rows[i + 1].help;
    help += goes_with_next ? fmt::format("{}, ", rows[i].name)
                           : fmt::format("{}: {}{}", rows[i].name, rows[i].help, i + 1 < rows.size() ? "; " : "");
  }
  return fmt::format("What turns a sketch into features. {} (models/sketch_trunks.h).", help);
}

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
