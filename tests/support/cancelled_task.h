#pragma once
#include "core/task.h"

namespace daumier::testing {

inline Task CancelledTask() {
  std::stop_source source;
  source.request_stop();
  return Task(source.get_token());
}

}  // namespace daumier::testing
