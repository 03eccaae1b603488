#pragma once
#include <cstdint>
#include <cstring>

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

/// Whether a comparison of lanes holds in one of them.
template <class Mask>
inline __attribute__((always_inline)) bool AnyLane(const Mask& mask) {
  int64_t words[sizeof(Mask) / sizeof(int64_t)];
  std::memcpy(words, &mask, sizeof(mask));
  int64_t any = 0;
  for (const int64_t word : words) any |= word;
  return any != 0;
}

}  // namespace daumier::raster
