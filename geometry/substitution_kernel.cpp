#include "geometry/substitution_kernel.h"

#include "core/kernels.h"

namespace daumier::geometry {
namespace {

using BlockRow =
    double __attribute__((vector_size(kBlockColumns * sizeof(double)), aligned(sizeof(double)), may_alias));

using SolvedRow =
    double __attribute__((vector_size(kSolvedColumns * sizeof(double)), aligned(sizeof(double)), may_alias));

}  // namespace

DAUMIER_FOR_EACH_PROCESSOR
void SubstituteForwards(const FactorColumns& lower, int num_rows, double* x) {
  auto* const rows = reinterpret_cast<SolvedRow*>(x);
  for (int j = 0; j < num_rows; ++j) {
    const SolvedRow solved = rows[j] / lower.values[lower.starts[j]];
    rows[j] = solved;
    for (int entry = lower.starts[j] + 1; entry < lower.starts[j + 1]; ++entry)
      rows[lower.rows[entry]] -= lower.values[entry] * solved;
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void SubstituteBackwards(const FactorColumns& lower, int num_rows, double* x) {
  auto* const rows = reinterpret_cast<SolvedRow*>(x);
  for (int j = num_rows - 1; j >= 0; --j) {
    SolvedRow sum = rows[j];
    for (int entry = lower.starts[j] + 1; entry < lower.starts[j + 1]; ++entry)
      sum -= lower.values[entry] * rows[lower.rows[entry]];
    rows[j] = sum / lower.values[lower.starts[j]];
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void SubstituteBlock(const FactorColumns& lower, const int* kept, const int* place, int first, int count, double* x) {
  auto* const rows = reinterpret_cast<BlockRow*>(x);
  for (int i = first; i < count; ++i) {
    const int column = kept[i], end = lower.starts[column + 1];
    int entry = lower.starts[column];
    const BlockRow solved = rows[i] / lower.values[entry];
    rows[i] = solved;
    for (++entry; entry < end; ++entry) rows[place[lower.rows[entry]]] -= lower.values[entry] * solved;
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void MultiplyBlocks(const double* a, const double* b, int first, int count, double* products) {
  const auto* const of_b = reinterpret_cast<const BlockRow*>(b);
  BlockRow sums[kBlockColumns] = {};
  for (int r = first; r < count; ++r) {
    const BlockRow row = of_b[r];
    const double* const factors = a + r * kBlockColumns;
#pragma GCC unroll 8
    for (int i = 0; i < kBlockColumns; ++i) sums[i] += factors[i] * row;
  }
  auto* const of_products = reinterpret_cast<BlockRow*>(products);
  for (int i = 0; i < kBlockColumns; ++i) of_products[i] = sums[i];
}

}  // namespace daumier::geometry
