#include "core/runtime.h"

#include "core/error.h"
#include "core/sgemm.h"
#include "core/stopwatch.h"

#include <dlfcn.h>
#include <dnnl.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <thread>
#include <vector>

namespace daumier {
namespace fs = std::filesystem;
namespace {

/// A function of whatever library is loaded; nullptr if there is none. This is how the dynamic linker binds LibTorch's
/// calls.
template <class Function>
Function* FindFunction(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

std::string LibraryOf(const void* function) {
  Dl_info info = {};
  if (function == nullptr || dladdr(function, &info) == 0 || info.dli_fname == nullptr) return "none";
  std::error_code error;
  const fs::path path = fs::canonical(info.dli_fname, error);
  return error ? info.dli_fname : path.string();
}

bool IsInThisProgram(const void* function) {
  Dl_info ours = {}, theirs = {};
  return dladdr(reinterpret_cast<const void*>(&DescribeBlas), &ours) != 0 && dladdr(function, &theirs) != 0 &&
         ours.dli_fbase == theirs.dli_fbase;
}

std::string OneDnnVersion() {
  auto* const version_of = FindFunction<decltype(dnnl_version)>("dnnl_version");
  if (version_of == nullptr) return "oneDNN";
  const dnnl_version_t* const version = version_of();
  return fmt::format("oneDNN {}.{}.{}", version->major, version->minor, version->patch);
}

std::atomic<int> asked_threads = 0;  ///< 0: all cores.

std::string OneDnnKernel() {
  auto* const isa_of = FindFunction<decltype(dnnl_get_effective_cpu_isa)>("dnnl_get_effective_cpu_isa");
  if (isa_of == nullptr) return "unknown";
  const dnnl_cpu_isa_t isa = isa_of();
  switch (isa) {
    case dnnl_cpu_isa_sse41:
      return "SSE4.1";
    case dnnl_cpu_isa_avx:
      return "AVX";
    case dnnl_cpu_isa_avx2:
      return "AVX2";
    case dnnl_cpu_isa_avx2_vnni:
      return "AVX2 with VNNI";
    case dnnl_cpu_isa_avx512_core:
      return "AVX-512";
    case dnnl_cpu_isa_avx512_core_vnni:
      return "AVX-512 with VNNI";
    case dnnl_cpu_isa_avx512_core_bf16:
      return "AVX-512 with VNNI and bfloat16";
    case dnnl_cpu_isa_avx512_core_amx:
      return "AVX-512 with VNNI, bfloat16 and AMX";
    default:
      return fmt::format("instruction set {:#x} of oneDNN", static_cast<unsigned>(isa));
  }
}

}  // namespace

int NumThreads() {
  return asked_threads > 0 ? asked_threads.load() : NumCores();
}

void SetUpRuntime(int threads) {
  if (threads < 0) throw UsageError(fmt::format("cannot compute with {} threads", threads));
  asked_threads = threads;
  if (auto* const set_num_threads = FindFunction<void(int)>("omp_set_num_threads")) {
    set_num_threads(NumThreads());
  }
}

void KeepFreedMemory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_TOP_PAD, 256 << 20);
}

void ShareOneHeap() {
  mallopt(M_ARENA_MAX, 1);
}

BlasInfo DescribeBlas() {
  const auto* const sgemm = reinterpret_cast<const void*>(FindSgemm());
  const std::string double_library = LibraryOf(dlsym(RTLD_DEFAULT, "dgemm_"));
  if (sgemm != nullptr && IsInThisProgram(sgemm)) return {OneDnnVersion(), OneDnnKernel(), double_library};
  return {LibraryOf(sgemm), sgemm == nullptr ? "none" : "chosen by the library", double_library};
}

bool HasBfloat16Instructions() {
  auto* const isa_of = FindFunction<decltype(dnnl_get_effective_cpu_isa)>("dnnl_get_effective_cpu_isa");
  if (isa_of == nullptr) return false;
  const auto isa = static_cast<unsigned>(isa_of()), wanted = static_cast<unsigned>(dnnl_cpu_isa_avx512_core_bf16);
  return (isa & wanted) == wanted;  // A set of instructions has the bits of those that it includes; AMX includes this.
}

double MeasureSgemm(int size, int repeats) {
  DAUMIER_CHECK(size > 0 && repeats > 0, "cannot measure {} products of size {}", repeats, size);
  Sgemm* const sgemm = FindSgemm();
  if (sgemm == nullptr) return 0;
  const size_t count = static_cast<size_t>(size) * static_cast<size_t>(size);
  const std::vector<float> a(count, 0.5f), b(count, 0.25f);
  std::vector<float> c(count);
  const float one = 1, zero = 0;
  double best_seconds = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= repeats; ++i) {
    const Stopwatch stopwatch;
    sgemm("N", "N", &size, &size, &size, &one, a.data(), &size, b.data(), &size, &zero, c.data(), &size);
    if (i > 0) best_seconds = std::min(best_seconds, stopwatch.seconds());
  }
  return 2e-9 * static_cast<double>(count) * size / best_seconds;
}

}  // namespace daumier
