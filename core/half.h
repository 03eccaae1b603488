#pragma once
#include <cstdint>

namespace daumier {

/// A number of IEEE 754 binary16, as safetensors' F16: 11 significant bits, at most 65504 in magnitude.
struct Half {
  uint16_t bits = 0;
  bool operator==(const Half&) const = default;
};

/// The largest finite Half.
inline constexpr float kLargestHalf = 65504;

/// The nearest Half, of two equally near ones the even one; infinite from 65520 on. NaN stays NaN.
Half HalfFromFloat(float value);

/// Exact.
float FloatFromHalf(Half half);

}  // namespace daumier
