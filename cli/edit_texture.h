#pragma once
#include "cli/edit_start.h"
#include "fitting/code_model.h"
#include "rig/head_rig.h"

#include <memory>

namespace daumier::cli {

/// Name of the atlas in the folder of an edit.
inline constexpr const char* kTextureFile = "texture.png";

/// The texture of all faces of an edit.
struct EditTexture {
  std::unique_ptr<const rig::HeadRig> rig;       ///< Of the model's topology; its atlas.
  std::shared_ptr<const render::Image> picture;  ///< Of that atlas, RGB.
  Json record;                                   ///< Of edit.json.
};

/// The texture of an edit: painted from the picture that the start was found in, size x size; or, of an edit that begins
/// with a code, the texture of the edit that this came from. @throws UsageError if there is neither; Error naming the
/// file if the earlier edit has no texture, or one of another topology, or as fitting::HeadPainter and rig::HeadRig.
EditTexture TextureOf(const EditStartArguments& arguments, const EditStart& start, const fitting::CodeModel& model,
                      int size);

}  // namespace daumier::cli
