#pragma once
#include "systems/system.h"

#include <vector>

namespace daumier::sketch {

/// The row of the sketch regressor in the training library.
systems::SystemTraining SketchTraining();
/// The row of the parser of drawings.
systems::SystemTraining ParserTraining();

/// The row of the classifier of pen gestures.
systems::SystemTraining GestureTraining();

/// The rows of this room.
std::vector<systems::SystemTraining> SketchTrainings();

}  // namespace daumier::sketch
