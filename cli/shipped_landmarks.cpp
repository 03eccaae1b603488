#include "cli/shipped_landmarks.h"

#include "systems/shipped_weights.h"

namespace daumier::cli {

ShippedLandmarks::ShippedLandmarks() {
  const std::vector<std::filesystem::path> places = systems::WeightsPlaces();
  const std::filesystem::path weights = systems::WeightsNamed("landmarks", systems::ListWeights(places), places);
  predictor_ = portrait::OpenLandmarkPredictor(weights, Device(), ToJson(portrait::LandmarkPredictOptions()));
}

const portrait::LandmarkDetector& ShippedLandmarks::detector() const {
  return dynamic_cast<const portrait::LandmarkPredictor&>(*predictor_).detector();
}

}  // namespace daumier::cli
