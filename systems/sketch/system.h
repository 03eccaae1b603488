#pragma once
#include "systems/system.h"

#include <vector>

namespace daumier::sketch {

/// The row of the sketch regressor.
systems::System SketchSystem();
/// The row of the parser of drawings.
systems::System ParserSystem();

/// The row of the classifier of pen gestures.
systems::System GestureSystem();

/// The rows of this room.
std::vector<systems::System> SketchSystems();

}  // namespace daumier::sketch
