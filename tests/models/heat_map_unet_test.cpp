#include "models/heat_map_unet.h"

#include "tests/support/expect_error.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

namespace daumier::models {
namespace {

HeatMapUnetOptions Small() {
  return {.channels = 1, .width = 8, .point_width = 16, .num_points = 24, .num_classes = 14, .states = {2, 3, 4}};
}

TEST(HeatMapUnet, MapsHaveAQuarterAHalfAndAnEighthOfTheSides) {
  torch::manual_seed(1);
  HeatMapUnet network(Small());
  network->eval();
  const torch::NoGradGuard no_grad;
  const HeatMapOutputs outputs = network->forward(torch::rand({2, 1, 64, 96}));
  EXPECT_EQ(outputs.heat_maps.sizes(), (std::vector<int64_t>{2, 24, 16, 24}));
  EXPECT_EQ(outputs.labels.sizes(), (std::vector<int64_t>{2, 14, 32, 48}));
  EXPECT_EQ(outputs.states.sizes(), (std::vector<int64_t>{2, 9}));
  EXPECT_EQ(outputs.boxes.sizes(), (std::vector<int64_t>{2, 5, 8, 12}));
}

TEST(HeatMapUnet, TheNetworkOfFacesAndThatOfDrawingsHaveLessThanAMillionParameters) {
  const HeatMapUnet faces(HeatMapUnetOptions{.states = {2, 2, 2, 2}});
  EXPECT_LT(faces->num_parameters(), 1'000'000);
  const HeatMapUnet drawings(HeatMapUnetOptions{
      .channels = 1, .num_points = 24, .num_classes = 14, .states = {3, 2, 2, 4}, .finds_boxes = false});
  EXPECT_LT(drawings->num_parameters(), 1'000'000);
}

TEST(HeatMapUnet, HeatMapsBeginFlatAndBoxesUnlikely) {
  torch::manual_seed(1);
  HeatMapUnet network(Small());
  const torch::NoGradGuard no_grad;
  const HeatMapOutputs outputs = network->forward(torch::rand({4, 1, 64, 64}));
  EXPECT_LT(outputs.heat_maps.std().item<double>(), 0.2);
  EXPECT_LT(outputs.boxes.select(1, 0).sigmoid().mean().item<double>(), 0.05);
}

TEST(HeatMapUnet, RefusesSidesThatAreNoMultiplesOf16AndMissingHeads) {
  HeatMapUnet network(Small());
  testing::ExpectError([&] { network->forward(torch::rand({1, 1, 64, 72})); }, "multiples of 16");
  testing::ExpectError([&] { network->forward(torch::rand({1, 3, 64, 64})); }, "pictures has shape");
  HeatMapUnetOptions options = Small();
  options.finds_boxes = false;
  HeatMapUnet without(options);
  testing::ExpectError([&] { without->Boxes(without->Features(torch::rand({1, 1, 32, 32}))); }, "has no search head");
  EXPECT_FALSE(without->forward(torch::rand({2, 1, 32, 32})).boxes.defined());
  options.width = 12;
  testing::ExpectError([&] { HeatMapUnet refused(options); }, "expected multiples of 8");
}

}  // namespace
}  // namespace daumier::models
