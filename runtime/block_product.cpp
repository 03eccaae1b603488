#include "runtime/block_product.h"

#include "core/kernels.h"

namespace daumier::runtime {
namespace {

/// A register of kLanes numbers. Wider vectors than the processor's own are taken apart one by one by g++. In memory
/// they lie anywhere in an array of floats; by memcpy g++ would keep them out of registers. Each width is written out
/// since g++ drops `may_alias` from types that depend on a template's argument.
template <int kLanes>
struct Register;

template <>
struct Register<16> {
  using Floats = float __attribute__((vector_size(64)));
  struct __attribute__((packed, may_alias)) InMemory {
    Floats value;
  };
};

template <>
struct Register<8> {
  using Floats = float __attribute__((vector_size(32)));
  struct __attribute__((packed, may_alias)) InMemory {
    Floats value;
  };
};

template <>
struct Register<4> {
  using Floats = float __attribute__((vector_size(16)));
  struct __attribute__((packed, may_alias)) InMemory {
    Floats value;
  };
};

template <int kLanes>
DAUMIER_INLINE void Load(const float* from, typename Register<kLanes>::Floats& to) {
  to = reinterpret_cast<const typename Register<kLanes>::InMemory*>(from)->value;
}

template <int kLanes>
DAUMIER_INLINE void Store(const typename Register<kLanes>::Floats& from, float* to) {
  reinterpret_cast<typename Register<kLanes>::InMemory*>(to)->value = from;
}

struct Factors {
  const float *a, *b;
  int64_t rows, inner, columns;
  bool add;
  float* c;
};

/// kRows x (kVectors kLanes) entries of c, which stay in registers while the inner index runs.
template <int kLanes, int kRows, int kVectors, bool kTransposed>
DAUMIER_INLINE void Tile(const Factors& f, int64_t row, int64_t column) {
  using Floats = typename Register<kLanes>::Floats;
  Floats sums[kRows][kVectors] = {};
  float* const c = f.c + row * f.columns + column;
  if (f.add) {
#pragma GCC unroll 16
    for (int r = 0; r < kRows; ++r) {
#pragma GCC unroll 2
      for (int v = 0; v < kVectors; ++v) Load<kLanes>(c + r * f.columns + v * kLanes, sums[r][v]);
    }
  }
  const float* a = kTransposed ? f.a + row : f.a + row * f.inner;
  const int64_t a_row = kTransposed ? 1 : f.inner, a_inner = kTransposed ? f.rows : 1;
  const float* b = f.b + column;
  for (int64_t k = 0; k < f.inner; ++k, a += a_inner, b += f.columns) {
    Floats right[kVectors];
#pragma GCC unroll 2
    for (int v = 0; v < kVectors; ++v) Load<kLanes>(b + v * kLanes, right[v]);
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
    for (int v = 0; v < kVectors; ++v) Store<kLanes>(sums[r][v], c + r * f.columns + v * kLanes);
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

void BlockProduct(const float* a, Factor form, const float* b, int64_t rows, int64_t inner, int64_t columns,
                  ProductTo to, float* c) {
  const Factors factors{a, b, rows, inner, columns, to == ProductTo::kSum, c};
  if (form == Factor::kTransposed) {
    Product<true>(factors);
  } else {
    Product<false>(factors);
  }
}

}  // namespace daumier::runtime
