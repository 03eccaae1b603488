#pragma once
#include "fitting/texture_fill.h"

#include <optional>
#include <vector>

namespace daumier::fitting {

/// What painting needs of a topology besides its atlas, a number a vertex of the texture space.
struct TextureGuide {
  std::vector<int> mirror;  ///< The vertex on the other side; -1: none.
  Eigen::VectorXf scalp;    ///< 1 where hair usually grows, 0 elsewhere, soft between.
  Eigen::VectorXf
      hair_painted;       ///< 1 where hair of a picture is painted on the head, 0 where it counts as an occluder.
  Eigen::VectorXf beard;  ///< 1 where beards grow: hair there is painted if the middle of a beard is seen.
  Eigen::VectorXf chin;   ///< The same about the middle of the face alone.
  Eigen::VectorXf ears;   ///< 1 there: what is parsed as ears is often background.
  std::vector<std::vector<int>> lids{};  ///< Vertices around the opening of each eye, right then left; may be empty.
};

enum class TextureFill {
  kNone,      ///< Unseen skin has the median colour of what is seen.
  kMirrored,  ///< The other side's colour where that is seen, else the median.
  kSmooth,    ///< The other side's colour, then the smoothest continuation over the surface.
};

/// Colours of the texels of skin, and where they come from.
struct SurfaceTexture {
  std::vector<Eigen::Vector3f> colours;  ///< A texel; 0 where it shows no triangle.
  std::vector<float> seen, mirrored;     ///< A texel: shares; what is left to 1 is filled.
};

/// The median of the known vertices, a channel; `otherwise` where none is known.
Eigen::Vector3f MedianColour(const VertexValues& known, const Eigen::Vector3f& otherwise);

/// How well a colour agrees with most of those that are known: 1 / (1 + (|colour - median| / deviation)^2)^2 [Geman & McClure
/// 1987], the deviation 1.5 times the median of |known - median|, at least 0.12. 1 where nothing is known.
class InlierMeasure {
 public:
  explicit InlierMeasure(const VertexValues& known);
  float operator()(const Eigen::Vector3f& colour) const;

 private:
  Eigen::Vector3f median_;
  float deviation_ = 0;
};

/// Completes what a picture shows of skin and hair (weights of both sum to at most 1 at a texel) over `surface`, of the
/// space's vertices. Mirror images are moved in tone by the difference between the sides where both are seen,
/// continued smoothly. Skin and hair are filled each for itself, from colours that count as InlierMeasure says.
/// With `albedo` (N x 3, as a model expects it; may be empty) skin is filled by its shape: what is continued is the
/// difference from the albedo, scaled to the seen colours, to which it falls off. What follows holds for hair: what is unseen is hair as far as the guide's scalp says
/// so, if the picture shows hair at all (`hair` is not null), and
/// nowhere more than hair_painted. @throws Error if a size disagrees.
SurfaceTexture CompleteSurface(const rig::TextureSpace& space, const rig::TexelMap& texels,
                               const MirroredCorners& mirror, const TextureGuide& guide, const SurfaceFill& surface,
                               const TexelColours& skin, const TexelColours* hair, const Eigen::MatrixXf& albedo = {},
                               TextureFill fill = TextureFill::kSmooth);

}  // namespace daumier::fitting
