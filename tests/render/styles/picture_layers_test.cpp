#include "render/styles/picture_layers.h"

#include "tests/render/styles/picture_example.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;

TEST(MakePictureLayers, AreMeansOfCoveredSamples) {
  PictureBuffers buffers = EmptyPictureBuffers(2, 2, 2);
  buffers.shade = {0.2f, 0.4f, 9, 9};
  buffers.depth[0] = 101;
  buffers.depth[1] = 100;
  buffers.classes = {1, 3, 0, 0};
  const PictureLayers layers = MakePictureLayers(buffers);
  EXPECT_EQ(layers.coverage.values[0], 0.5f);
  EXPECT_NEAR(layers.shade.values[0], 0.3f, 1e-6);
  EXPECT_EQ(layers.depth.values[0], 100);
  EXPECT_EQ(layers.classes[0], 3) << "of the nearest";
}

TEST(MakePictureLayers, BordersWithoutSupersamplingAreSoft) {
  const PictureLayers layers = MakePictureLayers(BallHead(64, 1));
  int num_soft = 0;
  for (const float coverage : layers.coverage.values) num_soft += coverage > 0 && coverage < 1 ? 1 : 0;
  EXPECT_GT(num_soft, 100);
  EXPECT_EQ(layers.coverage.at(32, 32), 1);
}

TEST(MakePictureLayers, RefusesValuesThatAreNotFinite) {
  PictureBuffers buffers = BallHead();
  buffers.shade[buffers.size() / 2 + 64] = NAN;
  daumier::testing::ExpectError([&] { MakePictureLayers(buffers); }, "not finite");
}

}  // namespace
}  // namespace daumier::render
