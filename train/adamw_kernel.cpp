#include "train/adamw_kernel.h"

#include <algorithm>
#include <array>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace daumier::train {

#if defined(__x86_64__)
namespace {

/// The factors in the precision of the numbers.
struct KernelFactors {
  explicit KernelFactors(const AdamWFactors& f)
      : beta1(float(f.beta1)),
        beta2(float(f.beta2)),
        rest1(float(1 - f.beta1)),
        rest2(float(1 - f.beta2)),
        decay(float(f.decay)),
        root_correction(float(f.root_correction)),
        negative_step(float(-f.step_size)) {}

  float beta1, beta2, rest1, rest2, decay, root_correction, negative_step;
};

// LibTorch fuses the product with the sum for the mean and for the square of the gradient, and rounds all else one by
// one. The last sum is written as a fused 1 * x + y, which rounds as x + y does and which no compiler fuses with the
// decay.

__attribute__((target("avx512f"))) int64_t Avx512(const KernelFactors& f, const AdamWNumbers& n, int64_t i,
                                                  int64_t end) {
  const __m512 beta1 = _mm512_set1_ps(f.beta1), beta2 = _mm512_set1_ps(f.beta2), rest1 = _mm512_set1_ps(f.rest1),
               rest2 = _mm512_set1_ps(f.rest2), decay = _mm512_set1_ps(f.decay),
               correction = _mm512_set1_ps(f.root_correction), step = _mm512_set1_ps(f.negative_step),
               epsilon = _mm512_set1_ps(1e-8f), one = _mm512_set1_ps(1);
  for (; i + 16 <= end; i += 16) {
    const __m512 g = _mm512_loadu_ps(n.gradient + i);
    const __m512 m = _mm512_fmadd_ps(g, rest1, _mm512_mul_ps(_mm512_loadu_ps(n.mean + i), beta1));
    const __m512 v = _mm512_fmadd_ps(_mm512_mul_ps(rest2, g), g, _mm512_mul_ps(_mm512_loadu_ps(n.square + i), beta2));
    const __m512 denominator = _mm512_add_ps(_mm512_div_ps(_mm512_maskz_sqrt_ps(0xffff, v), correction), epsilon);
    const __m512 p = _mm512_mul_ps(_mm512_loadu_ps(n.parameter + i), decay);
    _mm512_storeu_ps(n.mean + i, m);
    _mm512_storeu_ps(n.square + i, v);
    _mm512_storeu_ps(n.parameter + i, _mm512_fmadd_ps(one, _mm512_div_ps(_mm512_mul_ps(step, m), denominator), p));
  }
  return i;
}

__attribute__((target("avx2,fma"))) int64_t Avx2(const KernelFactors& f, const AdamWNumbers& n, int64_t i,
                                                 int64_t end) {
  const __m256 beta1 = _mm256_set1_ps(f.beta1), beta2 = _mm256_set1_ps(f.beta2), rest1 = _mm256_set1_ps(f.rest1),
               rest2 = _mm256_set1_ps(f.rest2), decay = _mm256_set1_ps(f.decay),
               correction = _mm256_set1_ps(f.root_correction), step = _mm256_set1_ps(f.negative_step),
               epsilon = _mm256_set1_ps(1e-8f), one = _mm256_set1_ps(1);
  for (; i + 8 <= end; i += 8) {
    const __m256 g = _mm256_loadu_ps(n.gradient + i);
    const __m256 m = _mm256_fmadd_ps(g, rest1, _mm256_mul_ps(_mm256_loadu_ps(n.mean + i), beta1));
    const __m256 v = _mm256_fmadd_ps(_mm256_mul_ps(rest2, g), g, _mm256_mul_ps(_mm256_loadu_ps(n.square + i), beta2));
    const __m256 denominator = _mm256_add_ps(_mm256_div_ps(_mm256_sqrt_ps(v), correction), epsilon);
    const __m256 p = _mm256_mul_ps(_mm256_loadu_ps(n.parameter + i), decay);
    _mm256_storeu_ps(n.mean + i, m);
    _mm256_storeu_ps(n.square + i, v);
    _mm256_storeu_ps(n.parameter + i, _mm256_fmadd_ps(one, _mm256_div_ps(_mm256_mul_ps(step, m), denominator), p));
  }
  return i;
}

int64_t WholeRegisters(const KernelFactors& f, const AdamWNumbers& n, int64_t begin, int64_t end) {
  static const bool has_avx512 = __builtin_cpu_supports("avx512f");
  return has_avx512 ? Avx512(f, n, begin, end) : Avx2(f, n, begin, end);
}

}  // namespace

bool HasAdamWKernel() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}

void AdamWKernel(const AdamWFactors& factors, const AdamWNumbers& numbers, int64_t begin, int64_t end) {
  const KernelFactors floats(factors);
  const int64_t rest = WholeRegisters(floats, numbers, begin, end);
  if (rest == end) return;
  // The last ones in a register of their own.
  std::array<float, 16> gradient{}, mean{}, square{}, parameter{};
  std::copy(numbers.gradient + rest, numbers.gradient + end, gradient.begin());
  std::copy(numbers.mean + rest, numbers.mean + end, mean.begin());
  std::copy(numbers.square + rest, numbers.square + end, square.begin());
  std::copy(numbers.parameter + rest, numbers.parameter + end, parameter.begin());
  WholeRegisters(floats, {gradient.data(), mean.data(), square.data(), parameter.data()}, 0, 16);
  std::copy_n(mean.begin(), end - rest, numbers.mean + rest);
  std::copy_n(square.begin(), end - rest, numbers.square + rest);
  std::copy_n(parameter.begin(), end - rest, numbers.parameter + rest);
}
#else
bool HasAdamWKernel() {
  return false;
}
void AdamWKernel(const AdamWFactors&, const AdamWNumbers&, int64_t, int64_t) {}
#endif

}  // namespace daumier::train
