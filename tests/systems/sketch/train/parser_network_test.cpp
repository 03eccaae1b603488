#include "systems/sketch/train/parser_network.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::sketch {
namespace {

TEST(ParserNetwork, ReturnsPointsLabelsAndStates) {
  models::HeatMapUnet network = MakeParserNetwork({.resolution = 64, .width = 16, .point_width = 16});
  network->eval();
  const torch::NoGradGuard no_grad;
  const models::HeatMapOutputs outputs = network->forward(torch::rand({1, 1, 64, 64}));
  EXPECT_EQ(outputs.heat_maps.sizes(), (std::vector<int64_t>{1, 26, 16, 16}));
  EXPECT_EQ(outputs.labels.sizes(), (std::vector<int64_t>{1, 14, 32, 32}));
  EXPECT_EQ(outputs.states.sizes(), (std::vector<int64_t>{1, 11}));
  EXPECT_FALSE(outputs.boxes.defined());
}

TEST(ParserNetwork, HasAtMostAMillionNumbers) {
  EXPECT_LE(MakeParserNetwork({})->num_parameters(), 1'000'000);
}

TEST(ParserNetwork, RefusesAResolutionThatIsNoMultipleOf16) {
  testing::ExpectError([] { MakeParserNetwork({.resolution = 100}); }, "network.resolution is 100");
}

}  // namespace
}  // namespace daumier::sketch
