#include "runtime/siren_math.h"

#include "core/kernels.h"

#include <cstring>

namespace daumier::runtime {
namespace {

// Sixteen numbers: one register of AVX-512, two of AVX2, four of SSE. They are handed over by reference, since vectors
// by value have another calling convention for each processor.
constexpr int64_t kLanes = 16;
using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
using Integers = int32_t __attribute__((vector_size(kLanes * sizeof(int32_t))));

DAUMIER_INLINE void Load(const float* from, int64_t count, Floats& to) {
  if (count == kLanes) {
    std::memcpy(&to, from, sizeof(to));
    return;
  }
  float padded[kLanes] = {};
  std::memcpy(padded, from, size_t(count) * sizeof(float));
  std::memcpy(&to, padded, sizeof(to));
}

DAUMIER_INLINE void Store(const Floats& from, int64_t count, float* to) {
  std::memcpy(to, &from, size_t(count) * sizeof(float));
}

/// sin(angle) and cos(angle) are those of the rest, |rest| <= pi / 2, with another sign after odd numbers of turns by
/// pi.
struct Reduced {
  Floats rest;
  Integers sign;  ///< In the place of a float's sign.
};

DAUMIER_INLINE void Reduce(const Floats& angle, Reduced& reduced) {
  // Adding 1.5 * 2^23 rounds to an integer, which then occupies the lowest bits.
  constexpr float kRounder = 12582912.0f;
  // pi in three parts; the first two have zeros behind, so that their products with small integers are exact.
  constexpr float kPi1 = 3.140625f, kPi2 = 9.67502593994140625e-4f, kPi3 = 1.509957990978376432e-7f;
  constexpr float kInversePi = 0.318309886183790672f;
  const Floats rounded = angle * kInversePi + kRounder;
  const Floats turns = rounded - kRounder;
  reduced.rest = ((angle - turns * kPi1) - turns * kPi2) - turns * kPi3;
  Integers bits;
  std::memcpy(&bits, &rounded, sizeof(bits));
  reduced.sign = bits << 31;
}

DAUMIER_INLINE void FlipSigns(const Integers& sign, Floats& numbers) {
  Integers bits;
  std::memcpy(&bits, &numbers, sizeof(bits));
  bits ^= sign;
  std::memcpy(&numbers, &bits, sizeof(bits));
}

// Polynomials of least greatest error on [-pi/2, pi/2]: 3.3e-9 and 4.7e-8.
DAUMIER_INLINE void Sine(const Reduced& angle, Floats& sine) {
  const Floats r = angle.rest, t = r * r;
  sine = r * (0.9999999765897388f +
              t * (-0.16666647634556364f +
                   t * (0.008332899822051681f + t * (-0.00019800897688021133f + t * 2.5904883577150652e-06f))));
  FlipSigns(angle.sign, sine);
}

DAUMIER_INLINE void Cosine(const Reduced& angle, Floats& cosine) {
  const Floats t = angle.rest * angle.rest;
  cosine = 0.999999953467341f +
           t * (-0.49999905347115614f +
                t * (0.04166358468992509f + t * (-0.0013853704273715964f + t * 2.3153930758698494e-05f)));
  FlipSigns(angle.sign, cosine);
}

DAUMIER_INLINE void SineOfSome(float* x, const float* bias, int64_t count, float omega) {
  Floats value, shift, sine;
  Reduced angle;
  Load(x, count, value);
  Load(bias, count, shift);
  Reduce((value + shift) * omega, angle);
  Sine(angle, sine);
  Store(sine, count, x);
}

DAUMIER_INLINE void SineAndSlopeOfSome(float* x, float* slope, const float* bias, int64_t count, float omega) {
  Floats value, shift, sine, cosine;
  Reduced angle;
  Load(x, count, value);
  Load(bias, count, shift);
  Reduce((value + shift) * omega, angle);
  Sine(angle, sine);
  Cosine(angle, cosine);
  Store(sine, count, x);
  Store(cosine * omega, count, slope);
}

}  // namespace

DAUMIER_FOR_EACH_PROCESSOR
void SineOfBlock(float* x, const float* bias, int64_t rows, int64_t width, float omega) {
  const int64_t whole = width / kLanes * kLanes;
  for (int64_t row = 0; row < rows; ++row, x += width) {
    for (int64_t i = 0; i < whole; i += kLanes) SineOfSome(x + i, bias + i, kLanes, omega);
    if (whole < width) SineOfSome(x + whole, bias + whole, width - whole, omega);
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void SineAndSlopeOfBlock(float* x, float* slope, const float* bias, int64_t rows, int64_t width, float omega) {
  const int64_t whole = width / kLanes * kLanes;
  for (int64_t row = 0; row < rows; ++row, x += width, slope += width) {
    for (int64_t i = 0; i < whole; i += kLanes) SineAndSlopeOfSome(x + i, slope + i, bias + i, kLanes, omega);
    if (whole < width) SineAndSlopeOfSome(x + whole, slope + whole, bias + whole, width - whole, omega);
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void MultiplyBlock(const float* factors, int64_t count, float* numbers) {
  for (int64_t begin = 0; begin < count; begin += kLanes) {
    const int64_t lanes = begin + kLanes <= count ? kLanes : count - begin;
    Floats factor, number;
    Load(factors + begin, lanes, factor);
    Load(numbers + begin, lanes, number);
    Store(number * factor, lanes, numbers + begin);
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void AddRowsOfBlock(const float* rows, int64_t num_rows, int64_t width, float* sum) {
  for (int64_t begin = 0; begin < width; begin += kLanes) {
    const int64_t lanes = begin + kLanes <= width ? kLanes : width - begin;
    Floats total, row;
    Load(sum + begin, lanes, total);
    for (int64_t i = 0; i < num_rows; ++i) {
      Load(rows + i * width + begin, lanes, row);
      total += row;
    }
    Store(total, lanes, sum + begin);
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void SumOfProductsOfBlock(const float* a, const float* b, int64_t num_rows, int64_t width, float* sum) {
  for (int64_t begin = 0; begin < width; begin += kLanes) {
    const int64_t lanes = begin + kLanes <= width ? kLanes : width - begin;
    Floats even = {}, odd = {}, x, y;
    int64_t i = 0;
    for (; i + 2 <= num_rows; i += 2) {
      Load(a + i * width + begin, lanes, x);
      Load(b + i * width + begin, lanes, y);
      even += x * y;
      Load(a + (i + 1) * width + begin, lanes, x);
      Load(b + (i + 1) * width + begin, lanes, y);
      odd += x * y;
    }
    if (i < num_rows) {
      Load(a + i * width + begin, lanes, x);
      Load(b + i * width + begin, lanes, y);
      even += x * y;
    }
    Store(even + odd, lanes, sum + begin);
  }
}

DAUMIER_FOR_EACH_PROCESSOR
void AddMultiplesOfRows(const float* const* rows, const float* factors, int64_t num_rows, int64_t width, float* sum) {
  for (int64_t r = 0; r < num_rows; r += 4) {
    const float* from[4];
    float factor[4];
    for (int64_t i = 0; i < 4; ++i) {
      from[i] = rows[r + i < num_rows ? r + i : r];
      factor[i] = r + i < num_rows ? factors[r + i] : 0;
    }
    for (int64_t begin = 0; begin < width; begin += kLanes) {
      const int64_t lanes = begin + kLanes <= width ? kLanes : width - begin;
      Floats total, row[4];
      Load(sum + begin, lanes, total);
      for (int i = 0; i < 4; ++i) Load(from[i] + begin, lanes, row[i]);
      total += factor[0] * row[0] + factor[1] * row[1] + (factor[2] * row[2] + factor[3] * row[3]);
      Store(total, lanes, sum + begin);
    }
  }
}

}  // namespace daumier::runtime
