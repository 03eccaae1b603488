#pragma once
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace daumier::raster {

/// Four numbers at a time, in the vector registers of the processor (GCC's and Clang's vector extension).
template <class T>
struct LanesOf {
  typedef T Type __attribute__((vector_size(4 * sizeof(T))));
};
template <class T>
using Lanes = typename LanesOf<T>::Type;

/// From and to memory of any alignment. Lanes are passed by reference: by value they would need AVX in the interface.
template <class T>
inline __attribute__((always_inline)) void LoadLanes(const T* from, Lanes<T>& lanes) {
  std::memcpy(&lanes, from, sizeof(lanes));
}
template <class T>
inline __attribute__((always_inline)) void StoreLanes(T* to, const Lanes<T>& lanes) {
  std::memcpy(to, &lanes, sizeof(lanes));
}

/// Four rows become four columns.
template <class T>
inline __attribute__((always_inline)) void Transpose(Lanes<T>& a, Lanes<T>& b, Lanes<T>& c, Lanes<T>& d) {
  const Lanes<T> ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes<T> cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Four records of four numbers, transposed: lanes[k] holds number k of each record. Records are `stride` numbers apart.
template <class T, class Rows>
inline __attribute__((always_inline)) void GatherRecords(const T* records, int64_t stride, const Rows& rows,
                                                         Lanes<T> (&lanes)[4]) {
  for (int k = 0; k < 4; ++k) LoadLanes(records + stride * rows[k], lanes[k]);
  Transpose<T>(lanes[0], lanes[1], lanes[2], lanes[3]);
}

/// Adds factor * lanes to memory.
template <class T>
inline __attribute__((always_inline)) void AddLanes(T* to, T factor, const Lanes<T>& lanes) {
  Lanes<T> sum;
  LoadLanes(to, sum);
  sum += factor * lanes;
  StoreLanes<T>(to, sum);
}

/// Whether a comparison of lanes holds in one of them.
template <class Mask>
inline __attribute__((always_inline)) bool AnyLane(const Mask& mask) {
#if defined(__SSE2__)
  if constexpr (sizeof(Mask) == sizeof(__m128)) {
    __m128 bits;
    std::memcpy(&bits, &mask, sizeof(mask));
    return _mm_movemask_ps(bits) != 0;
  }
#endif
  int64_t words[sizeof(Mask) / sizeof(int64_t)];
  std::memcpy(words, &mask, sizeof(mask));
  int64_t any = 0;
  for (const int64_t word : words) any |= word;
  return any != 0;
}

}  // namespace daumier::raster
