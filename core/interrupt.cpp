#include "core/interrupt.h"

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <thread>

namespace daumier {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
sem_t signalled;

struct StopState {
  std::mutex mutex;
  std::stop_source source;
};

/// Never destroyed: the thread that waits for signals may use it until the process ends.
StopState& State() {
  static StopState& state = *new StopState;
  return state;
}

void RequestStop() {
  StopState& state = State();
  std::stop_source source;
  {
    const std::lock_guard lock(state.mutex);
    source = state.source;
  }
  source.request_stop();  // Without the lock: it calls the callbacks of others.
}

void Handle(int) {
  interrupted = true;
  // The next signal of either kind ends the process at once.
  struct sigaction action = {};
  action.sa_handler = SIG_DFL;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  const int error = errno;
  sem_post(&signalled);  // Async-signal-safe, which request_stop is not.
  errno = error;
}

void StartWaiting() {
  static std::once_flag once;
  std::call_once(once, [] {
    sem_init(&signalled, 0, 0);
    std::thread([] {
      for (;;) {
        if (sem_wait(&signalled) == 0 && interrupted) RequestStop();
      }
    }).detach();
  });
}

}  // namespace

void CatchInterrupts() {
  StartWaiting();
  struct sigaction action = {};
  action.sa_handler = Handle;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool Interrupted() {
  return interrupted;
}

std::stop_token InterruptToken() {
  StopState& state = State();
  const std::lock_guard lock(state.mutex);
  return state.source.get_token();
}

void SetInterrupted(bool value) {
  interrupted = value;
  if (value) {
    RequestStop();
    return;
  }
  StopState& state = State();
  const std::lock_guard lock(state.mutex);
  if (state.source.stop_requested()) state.source = std::stop_source();
}

}  // namespace daumier
