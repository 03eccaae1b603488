#include "gltf/palette_texture.h"

#include "faces/appearance/skin_fields.h"
#include "rig/material_colours.h"

#include <algorithm>
#include <cmath>

namespace daumier::gltf {
namespace {

constexpr double kGutterShare = 12.0 / 1024;  // How far colours reach beyond charts.
constexpr float kBrowStrength = 0.75f, kBlushStrength = 0.35f;
const Eigen::RowVector3f kLips(0.72f, 0.41f, 0.39f), kBrows(0.30f, 0.20f, 0.14f), kBlush(0.85f, 0.50f, 0.44f);

/// A colour for each vertex of the head, NaN where it has none of its own.
Eigen::MatrixXf SkinColours(const rig::HeadRig& rig, const faces::FaceTemplate& face_template) {
  Eigen::MatrixXf colours =
      rig::MaterialColour(faces::HeadMaterial::kSkin).transpose().replicate(face_template.num_vertices(), 1);
  const auto blend = [&](const Eigen::VectorXd& weights, const Eigen::RowVector3f& colour, float strength) {
    for (Eigen::Index v = 0; v < colours.rows(); ++v)
      colours.row(v) += strength * float(weights[v]) * (colour - colours.row(v));
  };
  blend(faces::SkinField(face_template, "cheeks"), kBlush, kBlushStrength);
  blend(faces::SkinField(face_template, "brows"), kBrows, kBrowStrength);
  blend(faces::SkinField(face_template, "lips"), kLips, 1);
  Eigen::MatrixXf of_mesh(Eigen::Index(rig.finished_vertices().size()), 3);
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd values = rig.finished().Values(colours.col(channel).cast<double>());
    of_mesh.col(channel) = values(rig.finished_vertices()).cast<float>();
  }
  return of_mesh;
}

}  // namespace

render::Image PaletteTexture(const rig::HeadRig& rig, const faces::FaceTemplate& face_template, int size) {
  const rig::TextureSpace& space = rig.texture_space();
  const rig::TexelMap texels = space.Rasterise(size);
  const Eigen::MatrixXf skin = SkinColours(rig, face_template);
  const std::vector<int> shown = rig::NearestShownTexels(texels, int(std::ceil(kGutterShare * size)));
  render::Image picture(size, size, 3, 0);
  const Eigen::Vector3f background = rig::MaterialColour(faces::HeadMaterial::kSkin);
  for (int texel = 0; texel < texels.num_texels(); ++texel) {
    Eigen::Vector3f colour = background;
    if (const int source = shown[size_t(texel)]; source >= 0) {
      const int triangle = texels.triangles[size_t(source)];
      const faces::HeadMaterial material = space.materials[size_t(triangle)];
      colour = rig::MaterialColour(material);
      if (material == faces::HeadMaterial::kSkin) {
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (int k = 0; k < 3; ++k)
          sum += texels.weights[size_t(source)][k] * skin.row(space.triangles(triangle, k)).transpose();
        if (sum.allFinite()) colour = sum;
      }
    }
    for (int channel = 0; channel < 3; ++channel)
      picture.at(texel / size, texel % size, channel) =
          uint8_t(std::lround(255 * std::clamp(colour[channel], 0.0f, 1.0f)));
  }
  return picture;
}

}  // namespace daumier::gltf
