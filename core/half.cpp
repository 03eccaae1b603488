#include "core/half.h"

namespace daumier {
namespace {

constexpr uint32_t kFloatInfinity = 0x7f80'0000, kFloatMantissaBits = 23, kHalfMantissaBits = 10;
constexpr uint32_t kDroppedBits = kFloatMantissaBits - kHalfMantissaBits;
constexpr uint32_t kExponentDifference = 127 - 15;  // Of the two biases.
constexpr uint16_t kHalfInfinity = 0x7c00, kHalfNan = 0x7e00, kHalfSign = 0x8000;

}  // namespace

Half HalfFromFloat(float value) {
  const uint32_t bits = std::bit_cast<uint32_t>(value), magnitude = bits & 0x7fff'ffff;
  const auto sign = static_cast<uint16_t>((bits >> 16) & kHalfSign);
  const auto signed_half = [&](uint32_t half) { return Half{static_cast<uint16_t>(sign | half)}; };
  constexpr uint32_t kTooLarge = (kExponentDifference + 31) << kFloatMantissaBits;    // 65536
  constexpr uint32_t kLeastNormal = (kExponentDifference + 1) << kFloatMantissaBits;  // 2^-14
  if (magnitude >= kTooLarge) return signed_half(magnitude > kFloatInfinity ? kHalfNan : kHalfInfinity);
  if (magnitude < kLeastNormal) {
    // The last bit of floats in [0.5, 1) is that of subnormal halves: the addition rounds.
    constexpr float kRounder = 0.5F;
    const float rounded = std::bit_cast<float>(magnitude) + kRounder;
    return signed_half(std::bit_cast<uint32_t>(rounded) - std::bit_cast<uint32_t>(kRounder));
  }
  const uint32_t half_of_last = (1U << (kDroppedBits - 1)) - 1, odd = (magnitude >> kDroppedBits) & 1;
  const uint32_t rebased = magnitude - (kExponentDifference << kFloatMantissaBits);
  return signed_half((rebased + half_of_last + odd) >> kDroppedBits);
}

}  // namespace daumier
