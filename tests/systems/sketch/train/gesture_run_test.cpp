#include "systems/sketch/train/gesture_run.h"

#include "tests/support/expect_error.h"
#include "tests/support/gesture_run.h"

#include <gtest/gtest.h>

namespace daumier::sketch {
namespace {

class LoadedGestureRunTest : public testing::GestureRunTest {};

TEST_F(LoadedGestureRunTest, HasTheNetworkReadyToPredict) {
  const GestureRun run = LoadGestureRun(folder() / "run");
  EXPECT_FALSE(run.network->is_training());
  for (const torch::Tensor& parameter : run.network->parameters()) EXPECT_FALSE(parameter.requires_grad());
  testing::ExpectError([&] { LoadGestureRun(folder() / "gestures"); }, "gestures");
}

}  // namespace
}  // namespace daumier::sketch
