#include "systems/deform/train/unseen_faces.h"

#include "tensor/torch_version.h"

namespace daumier::deform {

double UnseenError(DeformNetwork& network, const torch::Tensor& faces, const CodeFitOptions& options) {
  double sum = 0;
  for (int64_t face = 0; face < faces.size(0); ++face) {
    const CodeFit fit = FitCode(network, faces[face], options);
    const at::NoGradGuard no_grad;
    sum += (network.DeformVertices(fit.code.unsqueeze(0))[0] - faces[face]).norm(2, 1).mean().item<double>();
  }
  return sum / double(faces.size(0));
}

}  // namespace daumier::deform
