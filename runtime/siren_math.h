#pragma once
#include <cstdint>

/// Elementwise operations of SIREN layers on whole blocks of numbers, in the widest vectors that the processor has.
/// Absolute errors of sines and cosines stay below 3e-7 for |omega (x + b)| < 2000.
namespace daumier::runtime {

/// x = sin(omega (x + b)), x: rows x width, b: width.
void SineOfBlock(float* x, const float* bias, int64_t rows, int64_t width, float omega);

/// The same, and slope = omega cos(omega (x + b)), its derivative by x; rows x width.
void SineAndSlopeOfBlock(float* x, float* slope, const float* bias, int64_t rows, int64_t width, float omega);

/// numbers *= factors, both count.
void MultiplyBlock(const float* factors, int64_t count, float* numbers);

/// sum (width) += the rows (num_rows x width).
void AddRowsOfBlock(const float* rows, int64_t num_rows, int64_t width, float* sum);

/// sum (width) = the sum over rows of a * b, both num_rows x width.
void SumOfProductsOfBlock(const float* a, const float* b, int64_t num_rows, int64_t width, float* sum);

/// sum (width) += sum_r factors[r] rows[r], rows wherever they lie.
void AddMultiplesOfRows(const float* const* rows, const float* factors, int64_t num_rows, int64_t width, float* sum);

}  // namespace daumier::runtime
