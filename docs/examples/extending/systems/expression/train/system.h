#pragma once
#include "systems/system.h"

namespace daumier::expression {

/// The row of the training library's table, cli/training/library.cpp.
systems::SystemTraining ExpressionTraining();

}  // namespace daumier::expression
