#pragma once
#include "systems/system.h"

#include <vector>

namespace daumier::portrait {

/// The row of landmarks in the training library.
systems::SystemTraining LandmarkTraining();

/// The rows of this room.
std::vector<systems::SystemTraining> PortraitTrainings();

}  // namespace daumier::portrait
