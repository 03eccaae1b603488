// A threaded product alone, and with another process that keeps one core busy. With passive waiting, which
// core/preinit.cpp sets, the second takes about twice as long; `OMP_WAIT_POLICY=active ./dev bench core_spin` shows
// what it would be otherwise.
#include "core/runtime.h"

#include <benchmark/benchmark.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace daumier {
namespace {

/// A process that computes for as long as this object lives.
class BusyProcess {
 public:
  BusyProcess() : pid_(fork()) {
    if (pid_ != 0) return;
    for (volatile unsigned turns = 0;;) turns = turns + 1;
  }
  ~BusyProcess() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  BusyProcess(const BusyProcess&) = delete;
  BusyProcess& operator=(const BusyProcess&) = delete;

 private:
  pid_t pid_;
};

/// One step is a chain of small products, between which all threads meet.
void Step(benchmark::State& state) {
  SetUpRuntime(0);
  for (auto _ : state) MeasureSgemm(192, 20);
}

void BM_Alone(benchmark::State& state) {
  Step(state);
}

void BM_BesideABusyCore(benchmark::State& state) {
  const BusyProcess busy;
  Step(state);
}

BENCHMARK(BM_Alone)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(BM_BesideABusyCore)->UseRealTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace daumier
