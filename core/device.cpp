#include "core/device.h"

#include "core/error.h"

#include <charconv>

namespace daumier {

Device ParseDevice(const std::string& text) {
  if (text == "cpu") return {};
  Device device{Device::Kind::kCuda, 0};
  if (text == "cuda") return device;
  const std::string prefix = "cuda:";
  const char* const end = text.data() + text.size();
  if (text.starts_with(prefix)) {
    const auto parsed = std::from_chars(text.data() + prefix.size(), end, device.index);
    if (parsed.ec == std::errc() && parsed.ptr == end && device.index >= 0) return device;
  }
  throw UsageError(fmt::format("device is '{}', expected cpu, cuda or cuda:N", text));
}

std::string DeviceName(const Device& device) {
  return device.kind == Device::Kind::kCpu ? "cpu" : fmt::format("cuda:{}", device.index);
}

}  // namespace daumier
