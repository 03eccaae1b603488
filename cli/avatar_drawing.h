#pragma once
#include "core/device.h"
#include "core/json.h"
#include "core/options.h"
#include "faces/face_model.h"
#include "fitting/palette_texture.h"
#include "render/sheet.h"
#include "rig/rigged_head.h"
#include "systems/portrait/avatar.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace daumier::cli {

/// Colours of a head that is made of a drawing, in any notation of CSS.
struct PaletteOptions {
  std::string skin = {}, lips = {}, brows = {}, iris = {};

  template <class V>
  void Visit(V&& visit) {
    visit("skin", skin, Text{},
          "Colour of the skin, as #e0ac8c or a name of CSS. Empty: that of the drawing if it is coloured there, else a "
          "plain one; so are the others.");
    visit("lips", lips, Text{}, "Colour of the lips.");
    visit("brows", brows, Text{}, "Colour of the brows.");
    visit("iris", iris, Text{}, "Colour of the irises.");
  }
};

/// A drawing as a rigged head.
struct DrawnHead {
  rig::RiggedHead head;
  std::shared_ptr<const faces::FaceTemplate> face_template;
  geometry::Points neutral;  ///< V x 3, cm: the face that was rigged.
  std::shared_ptr<const render::Image> texture;
  std::vector<render::SheetCell> stages;  ///< The drawing with the face's lines.
  Json milliseconds, facts;               ///< facts: {palette: {skin: {colour, from}, ...}}.
};

/// The face of the drawing by the shipped weights of the task `sketch`, with the 52 expressions and a texture of plain
/// colours (fitting::PaletteTexture). `edit` changes the face before it is rigged. `texture_size`: texels a side.
/// @throws UsageError if there are no weights, or if a colour of the palette is none; Error as the predictor.
DrawnHead MakeDrawnHead(const std::filesystem::path& drawing, const PaletteOptions& palette, int texture_size,
                        const portrait::FaceEdit& edit, const Device& device);

}  // namespace daumier::cli
