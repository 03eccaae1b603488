#pragma once
#include "systems/system.h"

namespace daumier::sketch {

/// The row of the sketch regressor.
systems::System SketchSystem();

}  // namespace daumier::sketch
