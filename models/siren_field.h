#pragma once
#include "runtime/siren_kernel.h"

#include <torch/types.h>

#include <vector>

namespace daumier::models {

/// Displacements (B, N, 3) of points (N, 3), or (B, N, 3), by B SIRENs whose parameters (B, layout.num_parameters())
/// are in the order of `layout`. Differentiable by the parameters, not by the points. On the CPU in float32 by
/// runtime::SirenKernel on all threads, elsewhere as SirenFieldByOperations. @throws Error if a shape disagrees, or if
/// points require a gradient.
torch::Tensor SirenField(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                         const torch::Tensor& points);

/// The same number by LibTorch's operators, layer by layer, differentiable by both: for other devices, for float64, for
/// tracing, and as a check.
torch::Tensor SirenFieldByOperations(const runtime::SirenLayout& layout, const torch::Tensor& parameters,
                                     const torch::Tensor& points);

}  // namespace daumier::models
