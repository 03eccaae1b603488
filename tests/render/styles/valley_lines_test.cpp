#include "render/styles/picture_lines.h"

#include "tests/render/styles/picture_example.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

TEST(ValleyLines, RunAlongAFoldAndNotAlongARidge) {
  for (const float sign : {1.0f, -1.0f}) {
    // n.z falls towards the fold, column 20, as where two cheeks meet, or rises to it.
    PictureBuffers buffers = EmptyPictureBuffers(40, 40);
    for (size_t i = 0; i < buffers.size(); ++i) {
      const float away = std::abs(static_cast<float>(i % 40) + 0.5f - 20) / 5;
      const float tilt = sign > 0 ? std::max(0.0f, 0.7f - 0.5f * away) : std::min(0.7f, 0.5f * away);
      buffers.depth[i] = 100;
      buffers.classes[i] = static_cast<uint8_t>(PictureClass::kSkin);
      buffers.normal[3 * i] = tilt;
      buffers.normal[3 * i + 2] = std::sqrt(1 - tilt * tilt);
    }
    PictureLayers layers = MakePictureLayers(buffers);
    layers.scale = 1;
    int num_in_fold = 0;
    for (const LinePoint& point : ValleyLines(layers)) num_in_fold += std::abs(point.x - 20) < 1 ? 1 : 0;
    if (sign > 0) {
      EXPECT_GT(num_in_fold, 25);
    } else {
      EXPECT_EQ(num_in_fold, 0);
    }
  }
}

}  // namespace
}  // namespace daumier::render
