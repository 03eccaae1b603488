#pragma once
#include "cli/edit_start.h"
#include "cli/edit_texture.h"
#include "core/manifest.h"

#include <filesystem>
#include <vector>

namespace daumier::cli {

/// `kind` of the manifest of a folder that `daumier edit` writes.
inline constexpr const char* kEditKind = "edit";

/// Faces of an edit, the start first, and what they were made of.
struct EditContent {
  std::vector<render::SheetCell> pictures;
  std::vector<EditedFace> faces;
  Json model, constraints;  ///< As edit.json has them.
  std::optional<EditTexture> texture;
  bool writes_ply = false;
  Manifest manifest;  ///< Without kind, counts and checksums.
};

/// Adds to each face's record `radius` (|code|), `usual` (whether it is within the model's usual radius), and,
/// against the first face, `moved_mm` (mean move of the vertices), `new_flips` and `self_intersections` (of the first
/// face as well).
void MeasureFaces(const fitting::CodeModel& model, std::vector<EditedFace>& faces);

/// The folder `out`, whole or not at all: NAME.obj and, with writes_ply NAME.ply of each face; sheet.png, each from
/// the front and from the side in one frame; edit.json {model, constraints, faces: [{name, code, latent, ...}]};
/// manifest.json. With a texture, NAME.obj is a head (reports::WriteTexturedHead) with NAME.mtl, texture.png is there,
/// the sheet shows each face painted, from the front and half from the side, and edit.json has `texture`. Returns what edit.json has, without the codes. @throws UsageError as CheckReplacedFolder.
Json WriteEdit(const std::filesystem::path& out, const fitting::CodeModel& model, const EditContent& content);

}  // namespace daumier::cli
