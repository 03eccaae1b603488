#pragma once
#include "faces/morphable_model.h"
#include "fitting/portrait_view.h"
#include "raster/mesh_topology.h"
#include "render/image.h"
#include "systems/portrait/portrait_crop.h"

#include <span>
#include <vector>

namespace daumier::portrait {

/// The pose among 239 coefficients. @throws Error if there are not 239.
fitting::PortraitPose PoseOfCoefficients(std::span<const float> coefficients);

/// A face of a model in a crop of 224 x 224.
struct FacePicture {
  std::vector<float> colours;    ///< 224 x 224 x 4: RGB over black, coverage 0 .. 1.
  std::vector<float> landmarks;  ///< 68 x 2, pixels.
};

/// Draws faces of a 3DMM as PortraitLoss renders them, without LibTorch.
class FacePainter {
 public:
  explicit FacePainter(const faces::MorphableModel& model);

  /// coefficients: 239. @throws Error if there are not 239.
  FacePicture Paint(std::span<const float> coefficients) const;
  /// The same of other vertices (V x 3, cm) and colours.
  FacePicture Paint(const faces::ColouredFace& face, std::span<const float> coefficients) const;

  const faces::MorphableModel& model() const { return model_; }

 private:
  const faces::MorphableModel& model_;
  const raster::MeshTopology topology_;
};

/// 1 x H x W: whether a class is skin, brow, lip or ear, of which the model has a surface.
std::vector<float> FaceMask(const render::Image& classes);

/// Colour difference of a rendered face: sum over RGB of |difference|, colours 0 .. 1, mean over the pixels that the face
/// covers and in which `shown` (224 x 224) is 1. NaN if there is none.
double PhotometricError(const FacePicture& face, const render::Image& crop, std::span<const float> shown);

/// The rendered face over the crop, `share` of it.
render::Image OverlayFace(const render::Image& crop, const FacePicture& face, double share = 1);
/// Landmarks (x0 y0 x1 y1 ..., pixels) as dots of that colour over the picture, of any size; those that are not finite
/// are skipped.
render::Image DotsOver(const render::Image& picture, std::span<const float> landmarks, const render::Rgb& colour);

}  // namespace daumier::portrait
