#pragma once
#include "systems/system.h"

namespace daumier::deform {

/// The row of the deformable model.
systems::System DeformSystem();

}  // namespace daumier::deform
