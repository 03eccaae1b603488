#pragma once
#include <bit>
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

/// Exact. In the header, so that loops over many become vector code.
inline float FloatFromHalf(Half half) {
  constexpr uint32_t kDropped = 23 - 10, kExponents = 0x7c00u << kDropped, kOfBiases = (127u - 15) << 23;
  const uint32_t sign = uint32_t{half.bits & 0x8000u} << 16, magnitude = uint32_t{half.bits & 0x7fffu} << kDropped;
  const uint32_t rebased = magnitude + kOfBiases, exponent = magnitude & kExponents;
  // Subnormal: the mantissa behind the leading 1 of 2^-14, less that.
  constexpr float kLeastNormal = 0x1p-14F;
  const auto subnormal = std::bit_cast<uint32_t>(std::bit_cast<float>(rebased + (1u << 23)) - kLeastNormal);
  const uint32_t not_finite = rebased + ((128u - 16) << 23);
  const uint32_t bits = exponent == 0 ? subnormal : exponent == kExponents ? not_finite : rebased;
  return std::bit_cast<float>(sign | bits);
}

}  // namespace daumier
