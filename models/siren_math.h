#pragma once
#include <cstdint>

/// The nonlinearity of SIREN layers on whole blocks of numbers, in the widest vectors that the processor has. Absolute
/// errors stay below 3e-7 for |omega (x + b)| < 2000.
namespace daumier::models {

/// x = sin(omega (x + b)), x: rows x width, b: width.
void SineOfBlock(float* x, const float* bias, int64_t rows, int64_t width, float omega);

/// The same, and slope = omega cos(omega (x + b)), its derivative by x; rows x width.
void SineAndSlopeOfBlock(float* x, float* slope, const float* bias, int64_t rows, int64_t width, float omega);

}  // namespace daumier::models
