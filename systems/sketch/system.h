#pragma once
#include "systems/system.h"

#include <vector>

namespace daumier::sketch {

/// The row of the sketch regressor.
systems::System SketchSystem();
/// The row of the parser of drawings.
systems::System ParserSystem();

/// The rows of this room.
std::vector<systems::System> SketchSystems();

}  // namespace daumier::sketch
