#include "systems/sketch/network_options.h"

#include "core/error.h"
#include "tests/support/expect_error.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

TEST(RequireWholeBlocks, RefusesOtherWidthsAndNamesTheNearest) {
  const auto require = [](const std::string& trunk, int width) {
    RequireWholeBlocks({.trunk = trunk, .width = width});
  };
  EXPECT_NO_THROW(require("compact", 16));
  EXPECT_NO_THROW(require("alexnet", 96));
  testing::ExpectError([&] { require("compact", 12); }, "(expected a multiple of 8): set network.width=8 or 16");
  testing::ExpectError([&] { require("residual", 4); }, "set network.width=8");
  testing::ExpectError([&] { require("alexnet", 16); }, "(expected a multiple of 24): set network.width=24");
  testing::ExpectError([&] { require("alexnet", 256); }, "set network.width=240");
  EXPECT_THROW(require("compact", 255), UsageError);
}

TEST(TrunkKinds, SayWhatATrunkReads) {
  EXPECT_TRUE((SketchNetworkOptions{.trunk = "residual"}.reads_image()));
  EXPECT_TRUE((SketchNetworkOptions{.trunk = "points"}.reads_points()));
  EXPECT_TRUE((SketchNetworkOptions{.trunk = "shape"}.reads_shape()));
  testing::ExpectError([] { TrunkNamed("resnet"); }, "there is no network.trunk \"resnet\" (expected compact, alexnet");
  EXPECT_NE(TrunkHelp().find("compact, alexnet, residual: convolutions of its picture; points: a point network on its "
                             "strokes; "),
            std::string::npos);
}

}  // namespace
}  // namespace daumier::sketch
