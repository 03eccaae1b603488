#pragma once
#include "systems/portrait/landmark_predictor.h"

#include <memory>

namespace daumier::cli {

/// The shipped network that finds landmarks in pictures and parses them. @throws UsageError if it is not there.
class ShippedLandmarks {
 public:
  ShippedLandmarks();
  const portrait::LandmarkDetector& detector() const;

 private:
  std::unique_ptr<const systems::Predictor> predictor_;
};

}  // namespace daumier::cli
