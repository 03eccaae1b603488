#pragma once
#include "systems/system.h"

#include <vector>

namespace daumier::portrait {

/// The row of landmarks and parsing.
systems::System LandmarkSystem();

/// The rows of this room.
std::vector<systems::System> PortraitSystems();

}  // namespace daumier::portrait
