#pragma once
#include <torch/types.h>

namespace daumier::models {

/// The camera of portraits [Deng et al. 2019]: perspective, focal length 1015 px and principal point (112, 112) of a
/// picture of 224 x 224, the viewer 100 cm in front of the origin.
struct PortraitCamera {
  double focal = 1015, centre = 112, distance = 100;
};

/// R = Rz(roll) Ry(yaw) Rx(pitch), (B, 3, 3), of angles (B, 3) = (pitch, yaw, roll) in radians. It turns columns: p ->
/// R p. @throws daumier::Error if the shape differs.
torch::Tensor RotationMatrices(const torch::Tensor& angles);

/// R p + t of points (B, N, 3) in cm under poses (B, 6) = (pitch, yaw, roll, t_x, t_y, t_z): y up, z to the viewer.
/// @throws daumier::Error if a shape differs.
torch::Tensor PosedPoints(const torch::Tensor& points, const torch::Tensor& poses);

/// Pixels (B, N, 2) of posed points (B, N, 3): x = c + f X / (d - Z) to the right, y = c - f Y / (d - Z) down.
/// @throws daumier::Error if the shape differs.
torch::Tensor ProjectedPoints(const torch::Tensor& posed, const PortraitCamera& camera = {});

}  // namespace daumier::models
