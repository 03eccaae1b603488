#pragma once
#include "fitting/portrait_view.h"
#include "fitting/texture_picture.h"
#include "raster/texture.h"
#include "rig/texture_space.h"

#include <Eigen/Core>

#include <vector>

namespace daumier::fitting {

/// From posed points to a picture of any size that the crop of a PortraitView was cut from: p_picture = linear p_view + shift.
struct PictureCamera {
  PortraitView view;
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  /// N x 2, pixels of the picture.
  PicturePoints PlacesOf(const geometry::Points& posed) const;
  /// Pixels of the picture a pixel of the view.
  double scale() const;
};

/// A texel where the picture shows it.
struct TexelSight {
  Eigen::Vector2f place = Eigen::Vector2f::Zero();  ///< Pixels of the picture.
  float sight = 0;  ///< 0 turned away or hidden .. 1: seen from about the front, nothing before it.
  float level = 0;  ///< log2 of pixels a texel: the mip level.
};

struct SightOptions {
  double hidden_facing = 0.12, full_facing = 0.5;  ///< Cosines to the viewer at which sight is 0 and 1.
  int side = 768;                                  ///< Pixels of the z-buffer along the longer side of the head.
  double tolerance_cm = 0.2;                       ///< A surface nearer by less hides nothing.
};

/// Projects each texel to the picture [Pan et al. 2024, eq. 12], and finds which ones it shows: those of triangles that
/// face the viewer and are in front (z-buffer, four depths a texel weighed bilinearly, so that borders of occluded parts are soft).
/// posed: the vertices of `space` as the picture shows them, R p + t, cm. Returns a sight a texel; 0 where it shows no
/// triangle. @throws Error if the number of vertices is less than the triangles name.
std::vector<TexelSight> FindTexelSights(const rig::TextureSpace& space, const rig::TexelMap& texels,
                                        const geometry::Points& posed, const PictureCamera& camera,
                                        const SightOptions& options = {});

/// Colours of texels and how well each is known.
struct TexelColours {
  std::vector<Eigen::Vector3f> colours;  ///< A texel: RGB.
  std::vector<float> weights;            ///< A texel: 0 unknown .. 1.
};

/// Reads a layer at texels' places. Keeps its own copies of the layer, halved again and again.
class LayerSampler {
 public:
  explicit LayerSampler(const PictureLayer& layer);

  /// Colours at the sights' places, averaged over about the area of a texel where the picture is the larger; weights:
  /// sight times the layer's confidence, 0 outside of the picture.
  TexelColours Sample(const std::vector<TexelSight>& sights) const;

 private:
  int height_, width_;
  raster::MipMap<float> mip_map_;
};

inline TexelColours SampleLayer(const PictureLayer& layer, const std::vector<TexelSight>& sights) {
  return LayerSampler(layer).Sample(sights);
}

}  // namespace daumier::fitting
