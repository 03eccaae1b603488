#include "tensor/autocast.h"

#include "tensor/torch_version.h"

#include <ATen/autocast_mode.h>

namespace daumier::tensor {
namespace {

#if DAUMIER_TORCH_AT_LEAST(2, 4)
bool Enabled(torch::DeviceType device) {
  return at::autocast::is_autocast_enabled(device);
}
void Turn(torch::DeviceType device, bool on) {
  at::autocast::set_autocast_dtype(device, torch::kBFloat16);
  at::autocast::set_autocast_enabled(device, on);
}
#else
bool Enabled(torch::DeviceType device) {
  return device == torch::kCPU ? at::autocast::is_cpu_enabled() : at::autocast::is_enabled();
}
void Turn(torch::DeviceType device, bool on) {
  if (device == torch::kCPU) {
    at::autocast::set_autocast_cpu_dtype(torch::kBFloat16);
    at::autocast::set_cpu_enabled(on);
  } else {
    at::autocast::set_autocast_gpu_dtype(torch::kBFloat16);
    at::autocast::set_enabled(on);
  }
}
#endif

}  // namespace

bool Autocast::IsOn(const torch::Device& device) {
  return Enabled(device.type());
}

Autocast::Autocast(const torch::Device& device, bool on) : device_(device.type()), was_on_(Enabled(device_)) {
  at::autocast::increment_nesting();
  Turn(device_, on);
}

Autocast::~Autocast() {
  // Weights cast for this step are those of this step alone.
  if (at::autocast::decrement_nesting() == 0) at::autocast::clear_cache();
  Turn(device_, was_on_);
}

}  // namespace daumier::tensor
