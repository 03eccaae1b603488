#include "fitting/texture_surface.h"

#include "core/error.h"
#include "core/parallel.h"

#include <algorithm>

namespace daumier::fitting {
namespace {

/// A plain colour for a head of which nothing is seen.
const Eigen::Vector3f kPlainSkin(0.80F, 0.62F, 0.53F);
/// Differences of tone are smoother than colours.
constexpr SurfaceFillOptions kToneFill{.stiffness = 8, .rest_weight = 1e-3};
/// Far from all that is seen, a colour drifts to the median within about ten edges: dark rims are not carried to the back.
constexpr SurfaceFillOptions kColourFill{.stiffness = 1, .rest_weight = 0.01};
/// A difference of tone that is usual: outlines and shadows at the border of what is seen differ by more.
constexpr float kUsualTone = 0.25F;
constexpr float kMostScale = 3;
/// Hair ends within a few edges of what is seen of it, but for the scalp.
constexpr SurfaceFillOptions kHairlineFill{.stiffness = 1, .rest_weight = 0.3};

/// Completes one kind of colour after the other.
class SurfaceCompletion {
 public:
  SurfaceCompletion(const rig::TextureSpace& space, const rig::TexelMap& texels, const MirroredCorners& mirror,
                    const SurfaceFill& surface, int num_vertices, TextureFill fill)
      : space_(space), texels_(texels), mirror_(mirror), surface_(surface), num_vertices_(num_vertices), fill_(fill) {}

  VertexValues AtVertices(const TexelColours& colours) const {
    return MeansAtVertices(space_.triangles, num_vertices_, texels_.triangles, texels_.weights, colours);
  }

  /// The mirror image of what is seen, in the tone of this side.
  TexelColours Image(const TexelColours& seen) const {
    TexelColours image = MirrorTexels(texels_, mirror_, seen);
    TexelColours difference = image;
    for (size_t i = 0; i < image.weights.size(); ++i) {
      difference.colours[i] = seen.colours[i] - image.colours[i];
      const float weight = std::min(image.weights[i], seen.weights[i]);
      const float t = 1 + difference.colours[i].squaredNorm() / (kUsualTone * kUsualTone);
      difference.weights[i] = weight * weight / (t * t);
    }
    const Eigen::MatrixXf tone =
        surface_.Solve(AtVertices(difference), Eigen::MatrixXf::Zero(num_vertices_, 3), kToneFill);
    for (size_t i = 0; i < image.weights.size(); ++i)
      if (image.weights[i] > 0) image.colours[i] += At(i, tone);
    return image;
  }

  /// A colour a vertex.
  Eigen::MatrixXf Fill(const TexelColours& known, const Eigen::Vector3f& otherwise,
                       const Eigen::MatrixXf& albedo = {}) const {
    VertexValues at_vertices = AtVertices(known);
    const InlierMeasure measure(at_vertices);
    for (Eigen::Index v = 0; v < at_vertices.weights.size(); ++v)
      at_vertices.weights[v] *= measure(at_vertices.values.row(v).transpose());
    const Eigen::Vector3f median = MedianColour(at_vertices, otherwise);
    Eigen::MatrixXf rest = median.transpose().replicate(num_vertices_, 1);
    if (fill_ != TextureFill::kSmooth) return rest;
    if (albedo.size() > 0) {
      const Eigen::Vector3f expected = MedianColour({albedo, at_vertices.weights}, otherwise);
      const Eigen::Array3f scale = (median.array() / expected.array().max(1e-2F)).min(kMostScale).max(1 / kMostScale);
      rest = (albedo.array().rowwise() * scale.transpose()).max(0.0F);
    }
    at_vertices.values -= rest;
    return rest + surface_.Solve(at_vertices, Eigen::MatrixXf::Zero(num_vertices_, 3), kColourFill);
  }

  /// The value of a texel of values at vertices.
  float At(size_t i, const Eigen::VectorXf& values) const {
    const int* const corner = space_.triangles.data() + 3 * size_t(texels_.triangles[i]);
    const Eigen::Vector3f& w = texels_.weights[i];
    return w[0] * values[corner[0]] + w[1] * values[corner[1]] + w[2] * values[corner[2]];
  }
  Eigen::Vector3f At(size_t i, const Eigen::MatrixXf& values) const {
    const int* const corner = space_.triangles.data() + 3 * size_t(texels_.triangles[i]);
    const Eigen::Vector3f& w = texels_.weights[i];
    return (w[0] * values.row(corner[0]) + w[1] * values.row(corner[1]) + w[2] * values.row(corner[2]))
        .head<3>()
        .transpose();
  }

 private:
  const rig::TextureSpace& space_;
  const rig::TexelMap& texels_;
  const MirroredCorners& mirror_;
  const SurfaceFill& surface_;
  const int num_vertices_;
  const TextureFill fill_;
};

/// Adds `share` of the image's texel to a known one.
void AddShare(const TexelColours& image, size_t i, float share, TexelColours& known) {
  const float weight = share * image.weights[i], sum = known.weights[i] + weight;
  if (weight <= 0) return;
  known.colours[i] += weight / sum * (image.colours[i] - known.colours[i]);
  known.weights[i] = sum;
}

}  // namespace

Eigen::Vector3f MedianColour(const VertexValues& known, const Eigen::Vector3f& otherwise) {
  Eigen::Vector3f median = otherwise;
  for (int k = 0; k < 3; ++k) {
    std::vector<float> values;
    for (Eigen::Index v = 0; v < known.weights.size(); ++v)
      if (known.weights[v] > 0) values.push_back(known.values(v, k));
    if (values.empty()) return otherwise;
    const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    median[k] = *middle;
  }
  return median;
}

InlierMeasure::InlierMeasure(const VertexValues& known) : median_(MedianColour(known, kPlainSkin)) {
  constexpr float kLeastDeviation = 0.12F;
  VertexValues distances = known;
  distances.values.col(0) = (known.values.rowwise() - median_.transpose()).rowwise().norm();
  if ((known.weights.array() > 0).any())
    deviation_ = std::max(kLeastDeviation, 1.5F * MedianColour(distances, Eigen::Vector3f::Zero())[0]);
}

float InlierMeasure::operator()(const Eigen::Vector3f& colour) const {
  if (deviation_ <= 0) return 1;
  const float t = 1 + (colour - median_).squaredNorm() / (deviation_ * deviation_);
  return 1 / (t * t);
}

SurfaceTexture CompleteSurface(const rig::TextureSpace& space, const rig::TexelMap& texels,
                               const MirroredCorners& mirror, const TextureGuide& guide, const SurfaceFill& surface,
                               const TexelColours& seen_skin, const TexelColours* seen_hair,
                               const Eigen::MatrixXf& albedo, TextureFill fill) {
  const size_t num_texels = size_t(texels.num_texels());
  DAUMIER_CHECK(seen_skin.weights.size() == num_texels && (!seen_hair || seen_hair->weights.size() == num_texels),
                "{} texels with {} weights", num_texels, seen_skin.weights.size());
  const int num_vertices = int(guide.mirror.size());
  const SurfaceCompletion completion(space, texels, mirror, surface, num_vertices, fill);
  TexelColours skin = seen_skin, hair = seen_hair ? *seen_hair : TexelColours{};

  SurfaceTexture texture;
  texture.seen.assign(num_texels, 0), texture.mirrored.assign(num_texels, 0);
  texture.colours.assign(num_texels, Eigen::Vector3f::Zero());
  for (size_t i = 0; i < num_texels; ++i) texture.seen[i] = skin.weights[i] + (seen_hair ? hair.weights[i] : 0.0F);
  if (fill != TextureFill::kNone) {
    OnAllCores(seen_hair ? 2 : 1, [&](int64_t kind) {
      TexelColours& known = kind == 0 ? skin : hair;
      const TexelColours image = completion.Image(known);
      for (size_t i = 0; i < num_texels; ++i) AddShare(image, i, 1 - texture.seen[i], known);
    });
    for (size_t i = 0; i < num_texels; ++i)
      texture.mirrored[i] = skin.weights[i] + (seen_hair ? hair.weights[i] : 0.0F) - texture.seen[i];
  }

  Eigen::MatrixXf skin_fill, hair_fill, hair_share;
  OnAllCores(seen_hair ? 2 : 1, [&](int64_t kind) {
    if (kind == 0) {
      skin_fill = completion.Fill(skin, kPlainSkin, albedo);
      return;
    }
    hair_fill = completion.Fill(hair, kPlainSkin);
    TexelColours share = hair;
    for (size_t i = 0; i < num_texels; ++i) {
      share.weights[i] = skin.weights[i] + hair.weights[i];
      if (share.weights[i] > 0) share.colours[i].setConstant(hair.weights[i] / share.weights[i]);
    }
    hair_share = surface.Solve(completion.AtVertices(share), guide.scalp.replicate(1, 3), kHairlineFill);
  });
  OnAllCores(int64_t(num_texels), [&](int64_t texel) {
    const auto i = size_t(texel);
    if (texels.triangles[i] < 0) return;
    Eigen::Vector3f filled = completion.At(i, skin_fill), known = skin.weights[i] * skin.colours[i];
    float weight = skin.weights[i];
    if (seen_hair) {
      filled += std::clamp(completion.At(i, hair_share)[0], 0.0F, completion.At(i, guide.hair_painted)) *
                (completion.At(i, hair_fill) - filled);
      known += hair.weights[i] * hair.colours[i];
      weight += hair.weights[i];
    }
    texture.colours[i] = known + (1 - weight) * filled;
  });
  return texture;
}

}  // namespace daumier::fitting
