#pragma once
#include "raster/camera.h"
#include "raster/colour_picture.h"
#include "raster/mesh_topology.h"

#include <torch/types.h>

#include <memory>

/// The renderer of raster/ as functions of LibTorch, on the CPU, in float32 or float64 (all tensors of a call alike); the
/// images of a batch in parallel. Results and gradients do not depend on the number of threads.
namespace daumier::models {

/// Kept by a picture until its gradient has been computed.
using SharedTopology = std::shared_ptr<const raster::MeshTopology>;

struct RenderedPictures {
  torch::Tensor pictures;  ///< (B, 3, H, W): colour over black, silhouettes antialiased. In front of a background:
                           ///< pictures + (1 - masks) * background.
  torch::Tensor masks;     ///< (B, 1, H, W): coverage, 0..1.
};

/// Triangles with a colour a vertex (raster/colour_picture.h). positions (B, V, 4): homogeneous pixel coordinates
/// (raster/camera.h); colours (B, V, 3). Both results are differentiable by x, y and w of the positions (depth has no
/// gradient) and by the colours. @throws Error if a shape disagrees, a tensor is not on the CPU or neither float32 nor
/// float64, or a number is not finite.
RenderedPictures RenderColours(const SharedTopology& topology, const torch::Tensor& positions,
                               const torch::Tensor& colours, int height, int width,
                               const raster::PictureOptions& options = {});

/// A shaded face (raster/face_picture.h). vertices (B, V, 3) in cm in the model's frame; albedo (B, V, 3), 0..1; light
/// (B, 9), spherical harmonics of one colour; pose (B, 6): pitch, yaw, roll in radians, translation in cm.
/// colour = albedo * shade(R normal). Differentiable by all four. @throws Error as RenderColours.
RenderedPictures RenderFace(const SharedTopology& topology, const torch::Tensor& vertices, const torch::Tensor& albedo,
                            const torch::Tensor& light, const torch::Tensor& pose, const raster::Camera& camera = {},
                            const raster::PictureOptions& options = {});

/// R p + t by LibTorch's operators: vertices (B, N, 3), pose (B, 6) -> (B, N, 3).
torch::Tensor PosedPoints(const torch::Tensor& vertices, const torch::Tensor& pose);

/// Homogeneous pixel coordinates (B, N, 4) of posed points (B, N, 3), by LibTorch's operators.
torch::Tensor ProjectedPoints(const torch::Tensor& points, const raster::Camera& camera = {});

/// Where the picture shows points, in pixels: (B, N, 3) in the model's frame, pose (B, 6) -> (B, N, 2). For losses on
/// landmarks.
torch::Tensor PointsInPicture(const torch::Tensor& vertices, const torch::Tensor& pose,
                              const raster::Camera& camera = {});

}  // namespace daumier::models
