#include "core/runtime.h"

#include "core/error.h"
#include "tests/support/process.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sched.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace daumier {
namespace {

TEST(Runtime, NegativeThreadsAreMisuse) {
  EXPECT_THROW(SetUpRuntime(-1), UsageError);
}

TEST(Runtime, SetUpSetsTheThreadsOfOpenMp) {
  auto* const max_threads = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "omp_get_max_threads"));
  if (max_threads == nullptr) GTEST_SKIP() << "no OpenMP run-time is loaded";
  SetUpRuntime(3);
  EXPECT_EQ(max_threads(), 3);
  SetUpRuntime(0);
  EXPECT_EQ(max_threads(), NumCores());
}

TEST(Runtime, Bfloat16InstructionsAreThoseInUse) {
  const char* const limit = std::getenv("ONEDNN_MAX_CPU_ISA");
  if (limit != nullptr) {
    if (limit == std::string("AVX2")) {
      EXPECT_FALSE(HasBfloat16Instructions());
    }
    return;
  }
  const std::string kernel = DescribeBlas().kernel;
  if (kernel.starts_with("AVX")) {
    EXPECT_EQ(HasBfloat16Instructions(), kernel.find("bfloat16") != std::string::npos) << kernel;
  }
  // oneDNN reads the variable once a process.
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const testing::ProcessResult limited = testing::RunProcess(
      {"/usr/bin/env", "ONEDNN_MAX_CPU_ISA=AVX2", self, "--gtest_filter=Runtime.Bfloat16InstructionsAreThoseInUse"});
  EXPECT_EQ(limited.exit_code, 0) << limited.out;
}

TEST(Runtime, MallocKeepsTheMemoryOfLargeArraysOnRequest) {
  KeepFreedMemory();
  constexpr size_t kSize = size_t{48} << 20;
  const size_t num_mapped_before = mallinfo2().hblks, free_before = mallinfo2().fordblks;
  void* const large = std::malloc(kSize);
  ASSERT_NE(large, nullptr);
  if (mallinfo2().uordblks == 0) {
    std::free(large);
    GTEST_SKIP() << "another allocator, as under the sanitizers";
  }
  EXPECT_EQ(mallinfo2().hblks, num_mapped_before);  // No mapping of its own, which would be given back at once.
  std::free(large);
  EXPECT_GE(mallinfo2().fordblks, std::max(free_before, kSize));
}

TEST(Runtime, MeasuredSpeedIsThatOfWhatTheProgramHas) {
  const bool has_sgemm = DescribeBlas().library != "none";
  EXPECT_EQ(MeasureSgemm(64, 2) > 0, has_sgemm);
  EXPECT_THROW(MeasureSgemm(0), Error);
}

}  // namespace
}  // namespace daumier
