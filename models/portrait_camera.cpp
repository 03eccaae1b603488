#include "models/portrait_camera.h"

#include "tensor/shape.h"

#include <ATen/Functions.h>

namespace daumier::models {

torch::Tensor RotationMatrices(const torch::Tensor& angles) {
  tensor::CheckShape(angles, {tensor::kAny, 3}, "angles");
  const torch::Tensor sine = angles.sin(), cosine = angles.cos();
  const torch::Tensor sx = sine.select(1, 0), sy = sine.select(1, 1), sz = sine.select(1, 2), cx = cosine.select(1, 0),
                      cy = cosine.select(1, 1), cz = cosine.select(1, 2);
  return at::stack({cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx,  //
                    sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx,  //
                    -sy, cy * sx, cy * cx},
                   1)
      .view({-1, 3, 3});
}

torch::Tensor PosedPoints(const torch::Tensor& points, const torch::Tensor& poses) {
  tensor::CheckShape(poses, {tensor::kAny, 6}, "poses");
  tensor::CheckShape(points, {poses.size(0), tensor::kAny, 3}, "points");
  const torch::Tensor rotations = RotationMatrices(poses.narrow(1, 0, 3));
  return at::matmul(points, rotations.transpose(1, 2)) + poses.narrow(1, 3, 3).unsqueeze(1);
}

torch::Tensor ProjectedPoints(const torch::Tensor& posed, const PortraitCamera& camera) {
  tensor::CheckShape(posed, {tensor::kAny, tensor::kAny, 3}, "posed");
  const torch::Tensor scale = camera.focal / (camera.distance - posed.select(2, 2));
  return at::stack({camera.centre + posed.select(2, 0) * scale, camera.centre - posed.select(2, 1) * scale}, 2);
}

}  // namespace daumier::models
