#pragma once
#include "systems/deform/train/code_fit.h"

#include <torch/types.h>

namespace daumier::deform {

/// Mean distance in model units, over all vertices and faces, of faces (n, V, 3) from what the network makes of the
/// codes that are found for them with it held fixed (FitCode).
double UnseenError(DeformNetwork& network, const torch::Tensor& faces, const CodeFitOptions& options);

}  // namespace daumier::deform
