#include "tensor/runtime.h"

#include "core/error.h"
#include "core/runtime.h"

#include <ATen/Parallel.h>
#include <torch/cuda.h>


namespace daumier::tensor {

int SetUpTorch(int threads) {
  DAUMIER_CHECK(threads >= 0, "threads is {}, expected 0 (all cores) or more", threads);
  at::set_num_threads(threads == 0 ? NumCores() : threads);
  return at::get_num_threads();
}

torch::Device TorchDevice(const Device& device) {
  if (device.kind == Device::Kind::kCpu) return torch::kCPU;
  const int num_devices = static_cast<int>(torch::cuda::device_count());
  DAUMIER_CHECK(device.index < num_devices,
                "no CUDA device {}: this LibTorch sees {}. Build Daumier against a CUDA build of LibTorch on a machine "
                "with an NVIDIA driver, or run with --device cpu",
                device.index, num_devices);
  return {torch::kCUDA, static_cast<c10::DeviceIndex>(device.index)};
}

}  // namespace daumier::tensor
