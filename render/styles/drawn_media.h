#pragma once
#include "core/random.h"
#include "render/styles/picture_layers.h"
#include "render/styles/style_choice.h"

namespace daumier::render {

/// What a medium starts from: the picture in paint, and the ink of its lines.
struct MediumInput {
  ColourPlanes colours;  ///< The composite with its background.
  Plane ink;             ///< Coverage by lines (DrawPictureLines).
};

/// Graphite or coloured pencils on paper: hatched by darkness, relative to that of lit skin, on the tooth of the paper;
/// lines in the same pencil.
ColourPlanes PencilDrawing(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng);

/// Pen and black ink on paper: lines, hatches in the shadows, black where the albedo is dark; with washes of colour.
ColourPlanes InkDrawing(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng);

/// Pigment on wet paper: the borders of washes are darker and deviate a little, pigment settles unevenly and in the tooth
/// of the paper: c' = c - (c - c^2)(d - 1) for a density d [Bousseau et al. 2006].
ColourPlanes Watercolour(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice, Rng& rng);

/// Comic print with screens of round dots: black on paper, shadows over flat colours, or all colours in cyan, magenta,
/// yellow and black at four angles.
ColourPlanes HalftonePrint(const MediumInput& input, const PictureLayers& layers, const StyleChoice& choice);

}  // namespace daumier::render
