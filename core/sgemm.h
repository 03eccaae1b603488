#pragma once
#include <dlfcn.h>

namespace daumier {

/// Fortran's product of float matrices, C = alpha op(A) op(B) + beta C, all column by column: transposed_a,
/// transposed_b, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc. op(A) is m x k, op(B) is k x n.
using Sgemm = void(const char*, const char*, const int*, const int*, const int*, const float*, const float*, const int*,
                   const float*, const int*, const float*, float*, const int*);

/// The sgemm_ that the libraries of this program call, LibTorch among them; nullptr where there is none. With RTLD_NEXT
/// the one that they would call if the caller's module had none.
inline Sgemm* FindSgemm(void* where = RTLD_DEFAULT) {
  return reinterpret_cast<Sgemm*>(dlsym(where, "sgemm_"));
}

}  // namespace daumier
