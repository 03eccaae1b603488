#pragma once
#include "fitting/code_fit.h"

#include <torch/types.h>

namespace daumier::eval {

/// Mean distance in model units, over all vertices and faces, of faces (n, V, 3) from what the network makes of the
/// codes that are found for them with it held fixed (fitting::FitCode).
double UnseenError(models::DeformNetwork& network, const torch::Tensor& faces, const fitting::CodeFitOptions& options);

}  // namespace daumier::eval
