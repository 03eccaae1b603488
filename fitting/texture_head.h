#pragma once
#include "core/options.h"
#include "faces/face_model.h"
#include "fitting/texture_eyes.h"
#include "fitting/texture_light.h"
#include "fitting/texture_surface.h"
#include "rig/head_rig.h"

#include <array>
#include <optional>
#include <vector>

namespace daumier::fitting {

/// For heads of HeadRig: the mirror map of the annotation, faces::Scalp::weights, and: hair is painted on the scalp, above
/// the brows and where beards grow. Vertices that are not the template's have no mirror image and no hair.
/// @throws Error as Scalp and SkinField.
TextureGuide MakeTextureGuide(const faces::FaceTemplate& face_template, const rig::HeadRig& rig);
/// The same for any numbering: joined_from_face is for each vertex of the template its number in a texture space of
/// `num_vertices`, -1: none. @throws Error also if its size differs.
TextureGuide MakeTextureGuide(const faces::FaceTemplate& face_template, const std::vector<int>& joined_from_face,
                              int num_vertices);

/// A head as a picture shows it.
struct ShownHead {
  geometry::Points vertices;                     ///< Of the texture space, with expression, not posed, cm.
  std::array<geometry::Vector3, 2> eye_centres;  ///< Likewise: the head's right eye, then its left one.
  PortraitPose pose = PortraitPose::Zero();
  PictureCamera camera;
  std::optional<PortraitLight> light;  ///< Needed to delight.
  Eigen::MatrixXf albedo{};  ///< Of the vertices, RGB, as a model expects it where nothing is seen; may be empty.
};

/// A face (V x 3, cm, with expression) of the rig's topology as its picture shows it: the head on it, and its eyes. albedo:
/// V x 3 or empty; other vertices of the head have its mean. @throws Error if its size differs.
ShownHead ShownHeadOf(const rig::HeadRig& rig, const geometry::Points& face, const PortraitPose& pose,
                      const PictureCamera& camera, const std::optional<PortraitLight>& light,
                      const Eigen::MatrixXf& albedo = {});

struct TextureOptions {
  int size = 1024;
  bool delight = true;
  bool fit_light = true;
  double light_share = 0.6;
  bool keep_gaze = false;
  double margin = 0.008;
  TextureFill fill = TextureFill::kSmooth;  ///< For measurements.

  template <class V>
  void Visit(V&& visit) {
    visit("size", size, Range{64, 4096}, "Side of the texture, texels.");
    visit("delight", delight, Flag{}, "Divide colours by the light of the picture, so that the texture is albedo.");
    visit("fit_light", fit_light, Flag{},
          "Fit that light to the picture's lightness over the aligned face, about that of the coefficients; otherwise "
          "it is that of the coefficients.");
    visit("light_share", light_share, Range{0, 1},
          "Share of the light's contrast that is removed: with 1 the texture is albedo if the light is right; with "
          "less it "
          "keeps some of the painter's shadows.");
    visit("keep_gaze", keep_gaze, Flag{},
          "The iris is where the picture shows it; otherwise in front, so that the head looks straight ahead.");
    visit("margin", margin, Range{0, 0.1},
          "Width of the border within which pixels of a part of the face are not trusted, as a share of the head's "
          "height.");
  }
};

/// The texture of a head, and what its texels of skin were taken from: shares that sum to 1.
struct HeadTexture {
  render::Image picture;  ///< size x size, RGB.
  render::Image
      sources;  ///< The same size, RGB: green what the picture shows, blue mirrored, red filled; black no skin.
  double seen = 0, mirrored = 0, filled = 0;
  std::optional<PortraitLight> light{};  ///< By which colours were divided.
};

/// Paints textures of the heads of one topology from pictures. Const and thread-safe.
class HeadPainter {
 public:
  /// @throws Error if the guide has not a number for each vertex, or as TextureSpace::Rasterise.
  HeadPainter(rig::TextureSpace space, TextureGuide guide, const TextureOptions& options = {});

  /// The texture of a head from a picture (RGB or grey, any size) and its parsing mask (PictureClass, of its size):
  ///   skin     the picture's colour where it shows it [Pan et al. 2024, eq. 12], nothing of hair, glasses, eyes and
  ///            background; the mirror image where that is seen, matched in tone; the smoothest continuation elsewhere.
  ///   scalp    likewise from the picture's hair, if it shows any; else skin.
  ///   eyes     PaintEye. Lid rims, mouth, teeth and tongue have plain colours.
  /// @throws Error if sizes disagree, or if options.delight and the head has no light.
  HeadTexture Paint(const ShownHead& head, const render::Image& picture, const render::Image& mask) const;

  const rig::TextureSpace& space() const { return space_; }
  const TextureOptions& options() const { return options_; }

 private:
  float At(size_t texel, const Eigen::VectorXf& values) const;
  render::Image EyesOf(const geometry::Points& posed, const PictureCamera& camera, const render::Image& mask) const;
  VertexValues AtVertices(const TexelColours& colours) const;
  void DoubtOutliers(const VertexValues& at_vertices, const Eigen::VectorXf* where, TexelColours& colours) const;
  TextureGuide GuideFor(const VertexValues& skin, const VertexValues& hair) const;
  void PaintEyes(const ShownHead& head, const PictureCamera& camera, const PictureLayer& eyes,
                 const std::optional<PortraitLight>& light, const Eigen::Vector3f& skin,
                 std::vector<Eigen::Vector3f>& colours) const;
  HeadTexture TextureOf(const SurfaceTexture& surface, std::vector<Eigen::Vector3f> colours) const;

  rig::TextureSpace space_;
  TextureGuide guide_;
  TextureOptions options_;
  rig::TexelMap texels_;
  std::vector<int> gutter_;  ///< NearestShownTexels.
  MirroredCorners mirrored_;
  std::optional<SurfaceFill> surface_;  ///< Over skin, neck and lid rims.
  std::array<EyeChart, 2> eyes_;
  Eigen::VectorXf mouth_depth_;  ///< A vertex of the space: 0 at the lips .. 1 in the mouth.
};

inline HeadTexture PaintHead(const rig::TextureSpace& space, const TextureGuide& guide, const ShownHead& head,
                             const render::Image& picture, const render::Image& mask,
                             const TextureOptions& options = {}) {
  return HeadPainter(space, guide, options).Paint(head, picture, mask);
}

}  // namespace daumier::fitting
