#include "systems/sketch/train/parser_network.h"

#include "core/error.h"
#include "datasets/styles/styled_dataset.h"

namespace daumier::sketch {

models::HeatMapUnet MakeParserNetwork(const ParserNetworkOptions& options) {
  DAUMIER_CHECK(options.resolution % 16 == 0, "network.resolution is {}, expected a multiple of 16",
                options.resolution);
  const auto& states = datasets::kDrawingStateClasses;
  return models::HeatMapUnet(models::HeatMapUnetOptions{.channels = 1,
                                                        .width = options.width,
                                                        .point_width = options.point_width,
                                                        .num_points = faces::kNumFacePoints,
                                                        .num_classes = faces::kNumLineLabels,
                                                        .states = {states.begin(), states.end()},
                                                        .finds_boxes = false});
}

}  // namespace daumier::sketch
