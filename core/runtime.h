#pragma once
#include "core/num_cores.h"

#include <string>
#include <string_view>

/// Settings of the process that precede any computation, and what `daumier info` prints of them. Independent of
/// LibTorch, whose own thread count the tensor room sets.
namespace daumier {

/// To be called first in main. Sets OpenMP's threads where an OpenMP run-time is loaded (0: one a core).
/// @throws UsageError if `threads` is negative.
void SetUpRuntime(int threads);

/// Makes malloc keep all memory that the process has once used, which spares a training step a tenth of its time in page
/// faults. For commands that repeat the same work; a process that lives for days would never give memory back.
void KeepFreedMemory();

/// From now on all threads allocate from one heap, for programs with many threads that are rarely busy at once: what one of them
/// frees another one reuses. Call it before there are threads. tools/consumers/studio_load measures what it does.
void ShareOneHeap();

/// The thread count given to SetUpRuntime; the number of cores before that call or if 0 was given.
int NumThreads();

/// Who multiplies matrices.
struct BlasInfo {
  std::string library;  ///< Float products: "oneDNN 2.6.3", or a library's path; "none" where the program has none.
  std::string kernel;   ///< The instructions that oneDNN uses, "AVX-512 with VNNI"; "chosen by the library" otherwise.
  std::string double_library;  ///< Double products: a library's path or "none".
};
BlasInfo DescribeBlas();

/// Whether oneDNN has the bfloat16 instructions of AVX-512 or AMX in use: those of the processor, less what
/// ONEDNN_MAX_CPU_ISA forbids. False where no oneDNN is loaded.
bool HasBfloat16Instructions();

/// GFLOP/s of size^3 float products through the sgemm_ that LibTorch calls, best of `repeats` after a first one to warm
/// up. 0 where the program has no sgemm_.
double MeasureSgemm(int size = 1024, int repeats = 5);

}  // namespace daumier
