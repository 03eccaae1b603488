#include "render/styles/picture_buffers.h"

#include "tests/render/styles/picture_example.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace daumier::render {
namespace {

using daumier::testing::BallHead;

TEST(CheckPictureBuffers, RefusesWhatDoesNotFit) {
  const auto refused = [&](auto&& spoil, const std::string& part) {
    PictureBuffers buffers = BallHead();
    spoil(buffers);
    daumier::testing::ExpectError([&] { CheckPictureBuffers(buffers); }, part);
  };
  refused([](PictureBuffers& b) { b.albedo.pop_back(); }, "albedo");
  refused([](PictureBuffers& b) { b.normal.pop_back(); }, "normal");
  refused([](PictureBuffers& b) { b.shade.push_back(0); }, "shade");
  refused([](PictureBuffers& b) { b.depth.clear(); }, "depth");
  refused([](PictureBuffers& b) { b.classes.pop_back(); }, "classes");
  refused([](PictureBuffers& b) { b.parts.pop_back(); }, "parts");
  refused([](PictureBuffers& b) { b.classes[0] = 8; }, "classes");
  refused([](PictureBuffers& b) { b.parts[0] = kNumPictureParts; }, "parts");
  refused([](PictureBuffers& b) { b.supersampling = 4; }, "supersampling");
  refused([](PictureBuffers& b) { b.supersampling = 3; }, "multiples");
  refused([](PictureBuffers& b) { b.pixels_per_cm = 0; }, "pixels_per_cm");
  daumier::testing::ExpectError([] { EmptyPictureBuffers(0, 4); }, "0 x 4");
}

}  // namespace
}  // namespace daumier::render
