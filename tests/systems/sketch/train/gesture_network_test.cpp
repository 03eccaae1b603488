#include "systems/sketch/train/gesture_network.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::sketch {
namespace {

TEST(GestureNetwork, BothKindsGiveElevenScores) {
  const torch::NoGradGuard no_grad;
  for (const char* kind : {"compact", "paper"}) {
    const GestureNetworkOptions options{.kind = kind};
    torch::nn::Sequential network = MakeGestureNetwork(options);
    network->eval();
    const int side = options.raster().side;
    EXPECT_EQ(network->forward(torch::rand({2, 1, side, side})).sizes(), (std::vector<int64_t>{2, 11})) << kind;
  }
}

TEST(GestureNetwork, ThePaperHasItsLayersAndCompactFitsIntoAMegabyte) {
  // 11 x 11 x 32, 5 x 5 x 32 x 64, 3 x 3 x 64 x 16, 8 x 8 x 16 x 256 and 256 x 11, with biases.
  EXPECT_EQ(NumParameters(*MakeGestureNetwork({.kind = "paper"})),
            121 * 32 + 32 + 25 * 32 * 64 + 64 + 9 * 64 * 16 + 16 + 1024 * 256 + 256 + 256 * 11 + 11);
  EXPECT_LT(2 * NumParameters(*MakeGestureNetwork({})), 500'000) << "bytes in float16";
}

}  // namespace
}  // namespace daumier::sketch
