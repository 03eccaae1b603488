#pragma once
#include "systems/system.h"

namespace daumier::sketch {

/// The row of the training library.
systems::SystemTraining SketchTraining();

}  // namespace daumier::sketch
