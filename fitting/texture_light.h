#pragma once
#include "fitting/texture_fill.h"
#include "raster/spherical_harmonics.h"
#include "rig/texture_space.h"

#include <Eigen/Core>

#include <array>

namespace daumier::fitting {

/// Monochrome light as of raster::Shade.
using PortraitLight = std::array<float, raster::kLightBands>;

struct LightFitOptions {
  double trust = 0.03;  ///< Weight of the start, as a share of that of the picture.
  double tolerance =
      1.5;  ///< Deviation of lightness at which a vertex counts a quarter, as multiples of the usual one.
  double mean_shade = 0.85;
  int num_iterations = 8;
};

/// The light under which a surface has the lightness that a picture shows of it, if its albedo is about even: minimises
///   sum_v w_v r_v (y_v - sum_k b_k phi_k(n_v))^2 + trust sum_v w_v |b - a (start + ambient)|^2
/// over b, y the lightness (0.299 R + 0.587 G + 0.114 B) of the known vertices, phi as of raster::Shade, a the scale that explains
/// y by the start best, and r = 1 / (1 + (residual / deviation)^2)^2 found in turns with b, so that brows, lips and highlights count
/// little [Geman & McClure 1987]. Scaled so that the mean shade of the known vertices is `mean_shade`: albedo is brighter than
/// its picture, as the light of whoever draws it makes it darker again. normals: N x 3, unit; colours: of the N vertices, RGB. Without a known
/// vertex: the start.
/// @throws Error if a size disagrees.
PortraitLight FitLight(const geometry::Points& normals, const VertexValues& colours, const PortraitLight& start,
                       const LightFitOptions& options = {});

/// Shades of N unit normals, at least `kLeastShade`.
Eigen::VectorXf ShadesOf(const geometry::Points& normals, const PortraitLight& light);
/// Of shades the contrast that counts: mean (shade / mean)^share, mean 0.85 (LightFitOptions).
Eigen::VectorXf WithContrast(const Eigen::VectorXf& shades, double share);
inline constexpr float kLeastShade = 0.5F;

/// Divides the colours of texels by the shade that they have by `shades` at the vertices of the space.
void DivideByShades(const rig::TextureSpace& space, const rig::TexelMap& texels, const Eigen::VectorXf& shades,
                    TexelColours& colours);

}  // namespace daumier::fitting
