#include "runtime/finite.h"

#include "core/kernels.h"

#include <cstdint>
#include <cstring>

namespace daumier::runtime {

DAUMIER_FOR_EACH_PROCESSOR
bool AreFinite(std::span<const float> numbers) {
  constexpr size_t kLanes = 16;
  using Integers = int32_t __attribute__((vector_size(kLanes * sizeof(int32_t))));
  constexpr int32_t kExponent = 0x7f800000;
  Integers found = {};  // -1 in lanes that have seen a number whose exponent is full.
  size_t i = 0;
  for (; i + kLanes <= numbers.size(); i += kLanes) {
    Integers bits;
    std::memcpy(&bits, numbers.data() + i, sizeof(bits));
    found |= (bits & kExponent) == kExponent;
  }
  int32_t any = 0;
  for (size_t lane = 0; lane < kLanes; ++lane) any |= found[lane];
  for (; i < numbers.size(); ++i) {
    int32_t bits;
    std::memcpy(&bits, numbers.data() + i, sizeof(bits));
    any |= (bits & kExponent) == kExponent ? -1 : 0;
  }
  return any == 0;
}

}  // namespace daumier::runtime
