#include "tensor/runtime.h"

#include "core/error.h"
#include "core/runtime.h"

#include <ATen/Parallel.h>
#include <torch/cuda.h>

#include <charconv>

namespace daumier::tensor {
int SetUpTorch(int threads) {
  DAUMIER_CHECK(threads >= 0, "threads is {}, expected 0 (all cores) or more", threads);
  at::set_num_threads(threads == 0 ? NumCores() : threads);
  return at::get_num_threads();
}

torch::Device ParseDevice(const std::string& name) {
  if (name == "cpu") return torch::kCPU;
  int index = 0;
  bool known = name == "cuda";
  if (name.starts_with("cuda:")) {
    const char* end = name.data() + name.size();
    const auto parsed = std::from_chars(name.data() + 5, end, index);
    known = parsed.ec == std::errc() && parsed.ptr == end && index >= 0;
  }
  if (!known) throw UsageError(fmt::format("device is '{}', expected cpu, cuda or cuda:N", name));
  const int num_devices = static_cast<int>(torch::cuda::device_count());
  DAUMIER_CHECK(index < num_devices,
                "no CUDA device {}: this LibTorch sees {}. Build Daumier against a CUDA build of LibTorch on a machine "
                "with an NVIDIA "
                "driver, or run with --device cpu",
                index, num_devices);
  return {torch::kCUDA, static_cast<c10::DeviceIndex>(index)};
}

}  // namespace daumier::tensor
