#pragma once
#include "fitting/portrait_fit.h"
#include "systems/portrait/train/portrait_measurement.h"

#include <span>
#include <vector>

namespace daumier::portrait {

/// The fit of a 3DMM to landmarks (68 x 2, pixels of a crop) as coefficients (239), with light and colours of the mean.
std::vector<float> FitCoefficients(const fitting::LandmarkModel& model, std::span<const float> landmarks,
                                   fitting::PortraitFreedom freedom);

/// The same of all portraits. landmarks: of each, in its crop.
PortraitGuesses FitAll(const faces::MorphableModel& model, const std::vector<std::vector<float>>& landmarks,
                       fitting::PortraitFreedom freedom);

}  // namespace daumier::portrait
