#pragma once
#include "systems/system.h"

namespace daumier::deform {

/// The row of the training library.
systems::SystemTraining DeformTraining();

}  // namespace daumier::deform
