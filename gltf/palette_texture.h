#pragma once
#include "faces/face_model.h"
#include "render/image.h"
#include "rig/head_rig.h"

namespace daumier::gltf {

/// The texture of a head that no picture gives one: rig::MaterialColour of each material, on the skin with lips, cheeks
/// and brows (faces::SkinField); size x size, RGB, gutters filled.
/// @throws Error as rig::TextureSpace::Rasterise and faces::SkinField.
render::Image PaletteTexture(const rig::HeadRig& rig, const faces::FaceTemplate& face_template, int size);

}  // namespace daumier::gltf
