#include "tensor/runtime.h"

#include "tests/support/expect_error.h"

#include <torch/cuda.h>

#include <thread>

namespace daumier::tensor {
namespace {

TEST(SetUpTorch, UsesAllCoresUnlessToldOtherwise) {
  EXPECT_EQ(SetUpTorch(1), 1);
  EXPECT_EQ(torch::get_num_threads(), 1);
  EXPECT_GE(SetUpTorch(), 1);
  EXPECT_LE(SetUpTorch(), static_cast<int>(std::thread::hardware_concurrency()));
  testing::ExpectError([] { SetUpTorch(-1); }, "threads is -1");
}

TEST(ParseDevice, KnowsCpuAndRefusesOtherWordsAsMisuse) {
  EXPECT_EQ(ParseDevice("cpu"), torch::Device(torch::kCPU));
  EXPECT_THROW(ParseDevice("gpu"), UsageError);
  EXPECT_THROW(ParseDevice("cuda:"), UsageError);
  EXPECT_THROW(ParseDevice("cuda:1x"), UsageError);
}

TEST(ParseDevice, FindsCudaOrSaysWhatToDo) {
  if (torch::cuda::is_available()) {
    EXPECT_EQ(ParseDevice("cuda"), torch::Device(torch::kCUDA, 0));
  } else {
    testing::ExpectError([] { ParseDevice("cuda"); }, "run with --device cpu");
  }
  testing::ExpectError([] { ParseDevice("cuda:99"); }, "no CUDA device 99");
}

}  // namespace
}  // namespace daumier::tensor
