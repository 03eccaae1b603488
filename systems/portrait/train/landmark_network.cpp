#include "systems/portrait/train/landmark_network.h"

#include "core/error.h"
#include "systems/portrait/landmark_sample.h"

namespace daumier::portrait {

models::HeatMapUnet MakeLandmarkNetwork(const LandmarkNetworkOptions& options) {
  DAUMIER_CHECK(options.resolution % 16 == 0, "network.resolution is {}, expected a multiple of 16",
                options.resolution);
  return models::HeatMapUnet(models::HeatMapUnetOptions{.channels = 3,
                                                        .width = options.width,
                                                        .point_width = options.point_width,
                                                        .num_points = kNumLandmarks,
                                                        .num_classes = kNumPictureClasses,
                                                        .states = std::vector<int>(size_t(kNumFaceStates), 2),
                                                        .finds_boxes = true});
}

}  // namespace daumier::portrait
