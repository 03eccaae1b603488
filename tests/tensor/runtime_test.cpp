#include "tensor/runtime.h"

#include "tests/support/expect_error.h"

#include <torch/cuda.h>

#include <torch/utils.h>
#include <thread>

namespace daumier::tensor {
namespace {

TEST(SetUpTorch, UsesAllCoresByDefault) {
  EXPECT_EQ(SetUpTorch(1), 1);
  EXPECT_EQ(torch::get_num_threads(), 1);
  EXPECT_GE(SetUpTorch(), 1);
  EXPECT_LE(SetUpTorch(), static_cast<int>(std::thread::hardware_concurrency()));
  testing::ExpectError([] { SetUpTorch(-1); }, "threads is -1");
}

TEST(TorchDevice, FindsCudaOrNamesTheRepair) {
  EXPECT_EQ(TorchDevice({}), torch::Device(torch::kCPU));
  const Device first{Device::Kind::kCuda, 0};
  if (torch::cuda::is_available()) {
    EXPECT_EQ(TorchDevice(first), torch::Device(torch::kCUDA, 0));
  } else {
    testing::ExpectError([&] { TorchDevice(first); }, "run with --device cpu");
  }
  testing::ExpectError([] { TorchDevice({Device::Kind::kCuda, 99}); }, "no CUDA device 99");
}

}  // namespace
}  // namespace daumier::tensor
