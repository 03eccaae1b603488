#include "fitting/palette_texture.h"

#include "core/parallel.h"
#include "faces/appearance/skin_fields.h"
#include "rig/material_colours.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace daumier::fitting {
namespace {

using faces::HeadMaterial;

constexpr int kPaletteGutter = 8;  // Texels of 1024.
constexpr float kRimShadeOfSkin = 0.82F, kInnerShadeOfLips = 0.8F, kLimbusShadeOfIris = 0.5F;

/// V x 3: skin, lips and brows.
Eigen::MatrixXf SkinColours(const faces::FaceTemplate& face, const HeadPalette& palette) {
  const Eigen::Index count = face.num_vertices();
  Eigen::MatrixXf colours = palette.skin.transpose().replicate(count, 1);
  const Eigen::Vector3f tone = palette.skin.cwiseQuotient(faces::kMeanSkin);
  for (const faces::AlbedoModeSpec& part : faces::MeanAlbedoParts()) {
    if (part.field == "lips" || part.field == "brows") continue;
    colours += faces::SkinField(face, part.field).cast<float>() * part.step.cwiseProduct(tone).transpose();
  }
  const auto paint = [&](const char* field, const Eigen::Vector3f& colour) {
    const Eigen::VectorXf share = faces::SkinField(face, field).cast<float>();
    for (Eigen::Index v = 0; v < count; ++v) colours.row(v) += share[v] * (colour.transpose() - colours.row(v));
  };
  paint("lips", palette.lips);
  paint("brows", palette.brows);
  return colours;
}

/// The colour of a whole triangle; absent where its vertices have one each.
std::optional<Eigen::Vector3f> PlainColour(HeadMaterial material, const HeadPalette& palette) {
  switch (material) {
    case HeadMaterial::kSkin:
      return std::nullopt;
    case HeadMaterial::kLidRim:
      return kRimShadeOfSkin * palette.skin;
    case HeadMaterial::kInnerLip:
      return kInnerShadeOfLips * palette.lips;
    case HeadMaterial::kIris:
      return palette.iris;
    case HeadMaterial::kLimbus:
      return kLimbusShadeOfIris * palette.iris;
    default:
      return rig::MaterialColour(material);
  }
}

}  // namespace

render::Image PaletteTexture(const rig::HeadRig& rig, const faces::FaceTemplate& face_template,
                             const HeadPalette& palette, int size) {
  const rig::TextureSpace& space = rig.texture_space();
  const Eigen::MatrixXf of_face = SkinColours(face_template, palette);
  // What is skin and no vertex of the face, as the cap of the neck, is plain.
  Eigen::MatrixXf colours = palette.skin.transpose().replicate(space.triangles.maxCoeff() + 1, 1);
  const std::vector<int>& finished = rig.finished_vertices();
  for (size_t joined = 0; joined < finished.size(); ++joined)
    if (finished[joined] < of_face.rows()) colours.row(Eigen::Index(joined)) = of_face.row(finished[joined]);

  const rig::TexelMap texels = space.Rasterise(size);
  const std::vector<int> shown = rig::NearestShownTexels(texels, std::max(1, kPaletteGutter * size / 1024));
  render::Image texture(size, size, 3, 0);
  OnAllCores(size, [&](int64_t row) {
    for (int column = 0; column < size; ++column) {
      const int from = shown[size_t(texels.index(int(row), column))];
      if (from < 0) continue;
      const int triangle = texels.triangles[size_t(from)];
      Eigen::Vector3f colour = Eigen::Vector3f::Zero();
      if (const auto plain = PlainColour(space.materials[size_t(triangle)], palette)) {
        colour = *plain;
      } else {
        for (int i = 0; i < 3; ++i)
          colour += texels.weights[size_t(from)][i] * colours.row(space.triangles(triangle, i)).transpose();
      }
      for (int c = 0; c < 3; ++c)
        texture.at(int(row), column, c) = uint8_t(std::clamp(255 * colour[c] + 0.5F, 0.0F, 255.0F));
    }
  });
  return texture;
}

}  // namespace daumier::fitting
