#pragma once
#include "faces/morphable_model.h"

#include <torch/types.h>

namespace daumier::models {

/// A 3DMM [Pan et al. 2024, eq. 1 and 2] as tensors: coefficients (B, 239) -> vertices, landmarks and colours. Numbers of
/// a slot that the model has no modes for have no effect. Every function throws daumier::Error if the shape differs.
class MorphableLayer {
 public:
  explicit MorphableLayer(const faces::MorphableModel& model, torch::ScalarType type = torch::kFloat32,
                          torch::Device device = torch::kCPU);

  /// (B, V, 3) in cm, posed by nothing.
  torch::Tensor Vertices(const torch::Tensor& coefficients) const;
  /// (B, 68, 3) in cm: the landmarks' rows of Vertices, without the others.
  torch::Tensor Landmarks(const torch::Tensor& coefficients) const;
  /// (B, V, 3), RGB.
  torch::Tensor Albedo(const torch::Tensor& coefficients) const;

  /// (T, 3) int32: the open surface.
  const torch::Tensor& triangles() const { return triangles_; }
  int64_t num_vertices() const { return mean_.size(0) / 3; }

 private:
  /// (B, S + E): identity and expression of the modes that there are.
  torch::Tensor ShapeNumbers(const torch::Tensor& coefficients) const;

  int64_t num_identity_, num_expression_;
  torch::Tensor mean_, shapes_;                    ///< (3V), (S + E, 3V)
  torch::Tensor landmark_mean_, landmark_shapes_;  ///< (204), (S + E, 204)
  torch::Tensor albedo_mean_, albedo_modes_;       ///< (3V), (A, 3V)
  torch::Tensor triangles_;
};

}  // namespace daumier::models
