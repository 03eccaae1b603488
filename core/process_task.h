#pragma once
#include "core/task.h"

namespace daumier {

/// The task of a command: cancelled by SetInterrupted(true), thus by Ctrl-C and SIGTERM after CatchInterrupts();
/// progress on stderr (ProgressPrinter). Every call makes a printer of its own. Only cli/ calls it; other functions
/// take a Task.
Task TaskOfProcess();

}  // namespace daumier
