#include "render/styles/ink_stamp.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {

void StampInk(Plane& ink, float x, float y, float half_width) {
  const float reach = half_width + 0.5f;
  if (!(reach > 0)) return;
  const int top = std::max(0, static_cast<int>(std::floor(y - reach))),
            bottom = std::min(ink.height - 1, static_cast<int>(std::floor(y + reach))),
            left = std::max(0, static_cast<int>(std::floor(x - reach))),
            right = std::min(ink.width - 1, static_cast<int>(std::floor(x + reach)));
  for (int row = top; row <= bottom; ++row) {
    float* target = ink.row(row);
    const float down = static_cast<float>(row) + 0.5f - y;
    for (int column = left; column <= right; ++column) {
      const float across = static_cast<float>(column) + 0.5f - x;
      const float coverage = std::min(reach - std::sqrt(across * across + down * down), 1.0f);
      target[column] = std::max(target[column], coverage);
    }
  }
}

}  // namespace daumier::render
