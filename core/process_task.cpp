#include "core/process_task.h"

#include "core/interrupt.h"
#include "core/progress.h"

namespace daumier {

Task TaskOfProcess() {
  const auto printer = std::make_shared<ProgressPrinter>();
  return Task(InterruptToken(), [printer](const TaskProgress& progress) { printer->Print(progress); });
}

}  // namespace daumier
