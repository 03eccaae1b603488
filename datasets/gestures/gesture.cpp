#include "datasets/gestures/gesture.h"

#include <array>

namespace daumier::datasets {

std::string NameOf(Gesture gesture) {
  static constexpr std::array kNames = {"line",        "region",      "left_arrow", "right_arrow",
                                        "up_roll_1",   "up_roll_2",   "up_roll_3",  "down_roll_1",
                                        "down_roll_2", "down_roll_3", "none"};
  return kNames[static_cast<size_t>(gesture)];
}

}  // namespace daumier::datasets
