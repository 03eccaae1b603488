#pragma once
#include "systems/system.h"

namespace daumier::portrait {

/// The row of the coarse portrait network.
systems::System PortraitSystem();

}  // namespace daumier::portrait
