// The program's own Fortran sgemm_, linked into every executable. A program's symbol comes before that of any library,
// so LibTorch's float products run on oneDNN, which makes its kernels for the processor at hand, whichever libblas is
// installed.
#include "core/sgemm.h"

#include <dnnl.h>

#include <algorithm>
#include <cstddef>

namespace {

/// In Fortran's words 'C' is the conjugate transpose, of real numbers the transpose.
char OneDnnWord(char word) {
  return word == 'N' || word == 'n' ? 'N' : 'T';
}

/// C = beta C, where 0 means "do not read C", which may hold NaN.
void Scale(int m, int n, float beta, float* c, int ldc) {
  for (int column = 0; column < n; ++column) {
    float* const values = c + static_cast<std::ptrdiff_t>(column) * ldc;
    if (beta == 0) {
      std::fill(values, values + m, 0.0f);
    } else if (beta != 1) {
      std::for_each(values, values + m, [beta](float& value) { value *= beta; });
    }
  }
}

}  // namespace

/// C = alpha op(A) op(B) + beta C; op(A): m x k, op(B): k x n, C: m x n, all column by column.
/// Throws nothing, since Fortran and OpenMP code calls it: what oneDNN refuses goes to the next library with a sgemm_, or is
/// computed by its definition.
extern "C" __attribute__((visibility("default"))) void sgemm_(const char* transposed_a, const char* transposed_b,
                                                              const int* m, const int* n, const int* k,
                                                              const float* alpha, const float* a, const int* lda,
                                                              const float* b, const int* ldb, const float* beta,
                                                              float* c, const int* ldc) {
  if (*m <= 0 || *n <= 0) return;
  if (*k <= 0 || *alpha == 0) return Scale(*m, *n, *beta, c, *ldc);
  // oneDNN is row-major and thus computes the transposes: C^T = op(B)^T op(A)^T.
  const dnnl_status_t status = dnnl_sgemm(OneDnnWord(*transposed_b), OneDnnWord(*transposed_a), *n, *m, *k, *alpha, b,
                                          *ldb, a, *lda, *beta, c, *ldc);
  if (status == dnnl_success) return;
  if (daumier::Sgemm* const next = daumier::FindSgemm(RTLD_NEXT))
    return next(transposed_a, transposed_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc);
  const bool a_is_plain = OneDnnWord(*transposed_a) == 'N', b_is_plain = OneDnnWord(*transposed_b) == 'N';
  const auto at = [](std::ptrdiff_t row, std::ptrdiff_t column, int ld) { return column * ld + row; };
  Scale(*m, *n, *beta, c, *ldc);
  for (int j = 0; j < *n; ++j)
    for (int i = 0; i < *m; ++i)
      for (int l = 0; l < *k; ++l)
        c[at(i, j, *ldc)] +=
            *alpha * a[a_is_plain ? at(i, l, *lda) : at(l, i, *lda)] * b[b_is_plain ? at(l, j, *ldb) : at(j, l, *ldb)];
}
