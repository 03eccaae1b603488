#pragma once
#include "models/morphable_layer.h"
#include "models/raster_function.h"
#include "systems/portrait/portrait_options.h"
#include "train/batch.h"
#include "train/recipe.h"

namespace daumier::portrait {

/// A 3DMM with the renderer and the camera of crops.
class PortraitRenderer {
 public:
  explicit PortraitRenderer(const faces::MorphableModel& model, torch::ScalarType type = torch::kFloat32);

  const models::MorphableLayer& layer() const { return layer_; }
  /// (B, 68, 2): pixels of the landmarks of coefficients (B, 239).
  torch::Tensor Landmarks(const torch::Tensor& coefficients) const;
  /// The faces over black, 224 x 224. vertices, albedo (B, V, 3): MorphableLayer's.
  models::RenderedPictures Render(const torch::Tensor& coefficients, const torch::Tensor& vertices,
                                  const torch::Tensor& albedo, bool antialias) const;

 private:
  models::MorphableLayer layer_;
  models::SharedTopology topology_;
};

/// What the training of a portrait network minimises [Pan et al. 2024, eq. 3], as a function of coefficients (B, 239):
///   landmarks * LandmarkLoss + photometric * PhotometricLoss + regulariser * CoefficientPriorLoss
///   + openings * (OpeningLoss of lids + 0.5 of lips) + reflectance * ReflectanceLoss
///   + vertices * KnownVertexLoss + coefficients * CoefficientLoss + angles * CoefficientLoss of pitch, yaw and roll,
/// terms of weight 0 left out. The photometric mask is A_m of the batch times the pixels that the rendered face covers.
class PortraitLoss {
 public:
  PortraitLoss(const faces::MorphableModel& model, const PortraitLossOptions& options,
               torch::ScalarType type = torch::kFloat32);

  /// batch: CropSamples'. Parts have the terms by name, without their weights.
  train::LossTerms operator()(const torch::Tensor& coefficients, const train::Batch& batch) const;

  const PortraitRenderer& renderer() const { return renderer_; }
  const PortraitLossOptions& options() const { return options_; }
  /// Of the batch's arrays those that it reads.
  bool reads_pictures() const { return options_.renders(); }
  bool reads_vertices() const { return options_.reads_vertices(); }

 private:
  const PortraitLossOptions options_;
  const PortraitRenderer renderer_;
  torch::Tensor skin_weights_, vertex_weights_, coefficient_weights_, angle_weights_;
};

}  // namespace daumier::portrait
