#pragma once
#include "fitting/texture_fill.h"

#include <Eigen/Core>

#include <optional>

namespace daumier::fitting {

/// The dark disc of an eye in a picture.
struct IrisDisc {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< Pixels.
  double radius = 0;                                 ///< Pixels.
};

/// The disc that parts the pixels of an eye best into dark ones within and light ones without: of the greatest
///   n_in n_out / n^2 (mean_out - mean_in)^2
/// of their lightness [Otsu 1979], over centres within the eye and radii of 0.12 to 0.5 of its width. The eye: the
/// layer's known pixels within `reach` of `middle`. Absent if there are fewer than 20 of them or the means differ by less
/// than 0.06.
std::optional<IrisDisc> FindIris(const PictureLayer& eyes, const Eigen::Vector2d& middle, double reach);

/// An eyeball as a picture shows it.
struct ShownEye {
  geometry::Vector3 centre;  ///< Posed, cm.
  Eigen::Matrix3d rotation;  ///< Of the head: from the eyeball's own axes to the camera's.
  geometry::Points points;   ///< Its vertices about its centre, looking to +z in its own axes, cm.
};

/// The turn of an eyeball, in its own axes, that brings its front pole to where the picture shows `iris`: by at most 35
/// degrees. Where the ray through the disc's centre passes the ball, the pole turns to the ball's border.
Eigen::Matrix3d TurnToIris(const ShownEye& eye, const PictureCamera& camera, const IrisDisc& iris);

/// The texels of an eye's chart.
struct EyeChart {
  std::vector<int> texels;               ///< Of the map.
  std::vector<int> triangles;            ///< Of each texel: a row of `corners`.
  std::vector<Eigen::Vector3f> weights;  ///< Of its corners.
  geometry::Triangles corners;           ///< Vertices of the eye, from 0.
  int first_vertex = 0;                  ///< That of the space which is vertex 0 of the eye.
};
EyeChart MakeEyeChart(const rig::TextureSpace& space, const rig::TexelMap& texels, rig::TextureChart chart);

/// Colours for the texels of an eye's chart, one each. Where the picture shows the eye: its colour divided by `shade`
/// [Pan et al. 2024, section 3.2.3], on the ball turned to the iris. Within the iris, what lids hide: the mean of what is
/// seen at the same distance from its centre. Elsewhere white, into which the seen white of the eye passes smoothly.
/// Where the picture shows no iris: a plain brown one. @throws Error if the eye's points are fewer than the chart's.
std::vector<Eigen::Vector3f> PaintEye(const EyeChart& chart, const ShownEye& eye, const PictureCamera& camera,
                                      const PictureLayer& eyes, float shade);

}  // namespace daumier::fitting
