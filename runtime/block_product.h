#pragma once
#include <cstdint>

namespace daumier::runtime {

/// Columns of b and c have to be a multiple of this.
inline constexpr int64_t kProductColumns = 16;

enum class Factor { kPlain, kTransposed };
enum class ProductTo { kValue, kSum };

/// A small matrix product for blocks that stay in the cache, on one thread, in the widest vectors that the processor
/// has: c = a b, or c += a b with ProductTo::kSum. a is rows x inner, or inner x rows with Factor::kTransposed; b is
/// inner x columns, c rows x columns; all row by row without gaps. A BLAS packs both factors for every block, which for blocks of a few
/// hundred rows costs as much as a third of the product.
void BlockProduct(const float* a, Factor form, const float* b, int64_t rows, int64_t inner, int64_t columns,
                  ProductTo to, float* c);

}  // namespace daumier::runtime
