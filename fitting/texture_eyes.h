#pragma once
#include "fitting/texture_fill.h"
#include "fitting/texture_iris.h"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace daumier::fitting {

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

/// The mask with eyes within the given openings alone (polygons of lids, pixels), background elsewhere: lashes and shadows of
/// lids, which a mask of few cells includes, are left out. Of an opening that is eye by less than 0.4, all skin counts as eye.
render::Image EyesWithin(const render::Image& mask, std::span<const PicturePoints> openings);

enum class Gaze {
  kAhead,  ///< The iris in front.
  kShown,  ///< Where the picture shows it.
};

/// The iris of an eye.
struct EyeLook {
  std::optional<IrisDisc> disc;            ///< Where the picture shows it.
  std::optional<IrisProfile> profile;      ///< Its colours; absent: those of a plain brown one.
  std::optional<Eigen::Vector3f> cover{};  ///< The colour of dark glasses, or of an eye that is drawn without white.
  float border = 0;                        ///< Sine of the angle between its axis and its border.
};

/// The irises of eyes of one head (FindIris). Those of a head have one size, that of the disc of the highest score; an eye
/// whose iris is not shown, or whose score is below 0.4 of that, has the colours of another one. A disc that is not darker than three quarters of the skin and of its
/// hue is none: it is a closed lid, or skin next to an eye that was found at a wrong place. Without any iris, an eye darker than 0.45 of the skin is covered. skin: RGB, of the picture.
std::vector<EyeLook> FindLooks(std::span<const ShownEye> shown, const PictureCamera& camera, const PictureLayer& eyes,
                               const Eigen::Vector3f& skin);

/// Colours for the texels of an eye's chart, one each. Where the picture shows the eye: its colour divided by `shade`
/// [Pan et al. 2024, section 3.2.3], on the ball turned to the iris. Within the iris, what lids hide: the median of what is
/// seen at the same distance from its centre. Elsewhere white, into which the seen white of the eye passes smoothly, of half
/// its saturation; what is darker than 0.55 of the bright white counts as shadow. White that is darker than 0.6 is made
/// lighter, by at most 1.8. Where the picture shows no iris: white alone around it. A covered eye has
/// the colour of its cover.
/// @throws Error if the eye's points are fewer than the chart's.
std::vector<Eigen::Vector3f> PaintEye(const EyeChart& chart, const ShownEye& eye, const PictureCamera& camera,
                                      const PictureLayer& eyes, const EyeLook& look, float shade,
                                      Gaze gaze = Gaze::kAhead);

}  // namespace daumier::fitting
