#include "models/block_product.h"

#define DAUMIER_INLINE inline __attribute__((always_inline))

namespace daumier::models {
namespace {

/// A register of so many numbers. Wider vectors than the processor's own are taken apart one by one by g++.
template <int kLanes>
struct Register {
  using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
  /// The same anywhere in an array. Registers are filled through it, not by memcpy, which keeps g++ from using
  /// registers.
  struct __attribute__((packed, may_alias)) InMemory {
    Floats value;
  };

  static DAUMIER_INLINE void Load(const float* from, Floats& to) {
    to = reinterpret_cast<const InMemory*>(from)->value;
  }
  static DAUMIER_INLINE void Store(const Floats& from, float* to) { reinterpret_cast<InMemory*>(to)->value = from; }
};

struct Factors {
  const float *a, *b;
  int64_t rows, inner, columns;
  bool add;
  float* c;
};

/// kRows x (kVectors kLanes) entries of c, which stay in registers while the inner index runs.
template <int kLanes, int kRows, int kVectors, bool kTransposed>
DAUMIER_INLINE void Tile(const Factors& f, int64_t row, int64_t column) {
  using Numbers = Register<kLanes>;
  typename Numbers::Floats sums[kRows][kVectors] = {};
  float* const c = f.c + row * f.columns + column;
  if (f.add) {
#pragma GCC unroll 16
    for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 2
      for (int v = 0; v < kVectors; ++v) Numbers::Load(c + r * f.columns + v * kLanes, sums[r][v]);
    }
  }
  const float* a = kTransposed ? f.a + row : f.a + row * f.inner;
  const int64_t a_row = kTransposed ? 1 : f.inner, a_inner = kTransposed ? f.rows : 1;
  const float* b = f.b + column;
  for (int64_t k = 0; k < f.inner; ++k, a += a_inner, b += f.columns) {
    typename Numbers::Floats right[kVectors];
#pragma GCC unroll 2
    for (int v = 0; v < kVectors; ++v) Numbers::Load(b + v * kLanes, right[v]);
#pragma GCC unroll 16
    for (int r = 0; r < kRows; ++r) {
      const float left = a[r * a_row];
#pragma GCC unroll 2
      for (int v = 0; v < kVectors; ++v) sums[r][v] += left * right[v];
    }
  }
#pragma GCC unroll 16
  for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 2
    for (int v = 0; v < kVectors; ++v) Numbers::Store(sums[r][v], c + r * f.columns + v * kLanes);
  }
}

template <int kLanes, int kRows, int kVectors, bool kTransposed>
DAUMIER_INLINE void Column(const Factors& f, int64_t column) {
  int64_t row = 0;
  for (; row + kRows <= f.rows; row += kRows) Tile<kLanes, kRows, kVectors, kTransposed>(f, row, column);
  for (; row < f.rows; ++row) Tile<kLanes, 1, kVectors, kTransposed>(f, row, column);
}

template <int kLanes, int kRows, bool kTransposed>
DAUMIER_INLINE void AllTiles(const Factors& f) {
  int64_t column = 0;
  for (; column + 2 * kLanes <= f.columns; column += 2 * kLanes) Column<kLanes, kRows, 2, kTransposed>(f, column);
  if (column < f.columns) Column<kLanes, kRows, 1, kTransposed>(f, column);
}

// As many rows as there are registers for: 32 of 512 bits, 16 of 256 bits.
#if defined(__x86_64__)
template <bool kTransposed>
__attribute__((target("avx512f"))) void ProductAvx512(const Factors& f) {
  AllTiles<16, 12, kTransposed>(f);
}
template <bool kTransposed>
__attribute__((target("avx2,fma"))) void ProductAvx2(const Factors& f) {
  AllTiles<8, 6, kTransposed>(f);
}
#endif
template <bool kTransposed>
void ProductAnywhere(const Factors& f) {
  AllTiles<4, 6, kTransposed>(f);
}

template <bool kTransposed>
void Product(const Factors& f) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return ProductAvx512<kTransposed>(f);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return ProductAvx2<kTransposed>(f);
#endif
  ProductAnywhere<kTransposed>(f);
}

}  // namespace

void BlockProduct(const float* a, bool transposed, const float* b, int64_t rows, int64_t inner, int64_t columns,
                  bool add, float* c) {
  const Factors factors{a, b, rows, inner, columns, add, c};
  if (transposed) {
    Product<true>(factors);
  } else {
    Product<false>(factors);
  }
}

}  // namespace daumier::models
