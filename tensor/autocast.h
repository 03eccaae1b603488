#pragma once
#include <torch/types.h>

namespace daumier::tensor {

/// While it lives, LibTorch's convolutions and matrix products on `device` read bfloat16 (8 bits of mantissa) and sum
/// in float32, if `on`; weights, normalisations and gradients of weights stay float32. With AMX or a GPU's tensor cores
/// a product is several times as fast. A processor without bfloat16 instructions gets slower, and LibTorch 1.13 sums in
/// bfloat16 there: a sum of ones stops at 256 (train/precision.h refuses it). What comes out of such layers is bfloat16.
/// Guards of one thread may be nested; each leaves what it found.
class Autocast {
 public:
  Autocast(const torch::Device& device, bool on);
  ~Autocast();
  Autocast(const Autocast&) = delete;
  Autocast& operator=(const Autocast&) = delete;

  /// Of this thread.
  static bool IsOn(const torch::Device& device);

 private:
  torch::DeviceType device_;
  bool was_on_;
};

}  // namespace daumier::tensor
