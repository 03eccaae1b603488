#pragma once
#include "systems/system.h"

namespace daumier::portrait {

/// The row of the training library.
systems::SystemTraining PortraitTraining();

}  // namespace daumier::portrait
