#pragma once
#include <string>

namespace daumier {

/// Where networks compute.
struct Device {
  enum class Kind { kCpu, kCuda };
  Kind kind = Kind::kCpu;
  int index = 0;  ///< Of several GPUs.

  bool operator==(const Device&) const = default;
};

/// The device of `--device cpu`, `--device cuda` or `--device cuda:N`. @throws UsageError for any other text.
Device ParseDevice(const std::string& text);
/// "cpu", "cuda:0".
std::string DeviceName(const Device& device);

}  // namespace daumier
