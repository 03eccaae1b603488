#pragma once
#include "faces/appearance/albedo_modes.h"
#include "faces/face_model.h"
#include "render/image.h"
#include "rig/head_rig.h"

#include <Eigen/Core>

namespace daumier::fitting {

/// Colours of a head that no picture shows, display RGB in 0 .. 1.
struct HeadPalette {
  Eigen::Vector3f skin = faces::kMeanSkin;
  Eigen::Vector3f lips{0.72f, 0.40f, 0.37f};
  Eigen::Vector3f brows{0.27f, 0.18f, 0.13f};
  Eigen::Vector3f iris{0.36f, 0.24f, 0.14f};
};

/// The atlas of heads of a rig, size x size, in plain colours: skin with the blush, lids and nostrils of a mean albedo
/// (faces::MeanAlbedoParts, times skin / kMeanSkin), lips and brows by their fields on the surface (faces::SkinField), rims
/// of lids, limbus and inner lips darker shades of what is next to them, other materials as rig::MaterialColour. Gutters
/// repeat their charts. face_template: that of the rig. @throws Error as rig::TextureSpace::Rasterise and SkinField.
render::Image PaletteTexture(const rig::HeadRig& rig, const faces::FaceTemplate& face_template,
                             const HeadPalette& palette, int size);

}  // namespace daumier::fitting
