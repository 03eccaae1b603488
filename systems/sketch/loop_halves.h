#pragma once
#include "systems/sketch/session_curves.h"

#include <array>
#include <optional>
#include <vector>

namespace daumier::sketch {

/// One closed stroke that redraws two lines with the same ends, as a person draws an eye.
struct LoopHalves {
  std::array<PenLine, 2>
      lines;  ///< The upper and the lower part, divided at its two points farthest along the line through those ends.
  std::vector<size_t> erased;  ///< Curves that are erased whole first.
};

/// Of a stroke that closes around two gaps with the same ends; or around a curve with a gap and its partner, of which a person has erased
/// one and draws both: its middle is within half their length of theirs, and it is kLeastLoop of it long. Of several such pairs the
/// nearest counts. Nothing of any other stroke, above all if its ends are farther from each other than kOpenLoop of its length.
std::optional<LoopHalves> HalvesOfLoop(const SessionLines& lines, const PenLine& stroke);

/// Share of its length that a closed stroke may leave open, and least length of a loop along the two lines, as a share of theirs.
inline constexpr double kOpenLoop = 0.2, kLeastLoop = 0.6;

}  // namespace daumier::sketch
