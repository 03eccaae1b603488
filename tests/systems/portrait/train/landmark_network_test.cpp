#include "systems/portrait/train/landmark_network.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::portrait {
namespace {

TEST(LandmarkNetwork, ReturnsLandmarksClassesStatesAndBoxes) {
  models::HeatMapUnet network = MakeLandmarkNetwork({.resolution = 64, .width = 8, .point_width = 16});
  network->eval();
  const torch::NoGradGuard no_grad;
  const models::HeatMapOutputs outputs = network->forward(torch::rand({1, 3, 64, 64}));
  EXPECT_EQ(outputs.heat_maps.sizes(), (std::vector<int64_t>{1, 68, 16, 16}));
  EXPECT_EQ(outputs.labels.sizes(), (std::vector<int64_t>{1, 8, 32, 32}));
  EXPECT_EQ(outputs.states.sizes(), (std::vector<int64_t>{1, 8}));
  EXPECT_EQ(outputs.boxes.sizes(), (std::vector<int64_t>{1, 5, 8, 8}));
}

TEST(LandmarkNetwork, FitsTheBudgetOfItsWeights) {
  EXPECT_LT(2 * MakeLandmarkNetwork({})->num_parameters(), 6'000'000);  // Bytes as float16.
}

TEST(LandmarkNetwork, RefusesAResolutionThatIsNoMultipleOf16) {
  testing::ExpectError([] { MakeLandmarkNetwork({.resolution = 100}); }, "network.resolution is 100");
}

}  // namespace
}  // namespace daumier::portrait
