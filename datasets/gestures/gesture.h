#pragma once
#include <cstddef>
#include <string>

/// Pen gestures of one stroke [Han et al. 2017, section 3.3 and figure 4].
namespace daumier::datasets {

/// The printed figure shows pictures alone; what a class is here, y down:
enum class Gesture {
  kLine,        ///< Open, nearly straight, in any direction.
  kRegion,      ///< Closed or nearly closed, any shape, around an area.
  kLeftArrow,   ///< A roughly horizontal shaft with a hook of one or two barbs at its left end.
  kRightArrow,  ///< The same at its right end.
  kUpRoll1,     ///< Climbs from the lower left to the upper right with one loop.
  kUpRoll2,
  kUpRoll3,
  kDownRoll1,  ///< Falls from the upper left to the lower right with one loop.
  kDownRoll2,
  kDownRoll3,
  kNone,  ///< Any other stroke.
};
inline constexpr int kNumGestures = 10;  ///< Without kNone.

/// "line", "region", "left_arrow", "right_arrow", "up_roll_1" ..., "down_roll_3", "none".
std::string NameOf(Gesture gesture);

}  // namespace daumier::datasets
