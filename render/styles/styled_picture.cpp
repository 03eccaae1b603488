#include "render/styles/styled_picture.h"

#include "render/styles/drawn_media.h"
#include "render/styles/painting.h"
#include "render/styles/picture_layers.h"
#include "render/styles/picture_lines.h"
#include "render/styles/surface_colours.h"

#include <algorithm>
#include <cmath>

namespace daumier::render {
namespace {

void LayOverBackground(const PictureLayers& layers, const ColourPlanes& colours, ColourPlanes& background) {
  for (int channel = 0; channel < 3; ++channel) {
    const float *source = colours[channel].values.data(), *coverage = layers.coverage.values.data();
    float* target = background[channel].values.data();
    for (size_t i = 0; i < layers.size(); ++i) target[i] = target[i] * (1 - coverage[i]) + source[i] * coverage[i];
  }
}

ColourPlanes SurfaceColours(const PictureLayers& layers, const StyleChoice& choice) {
  switch (choice.style) {
    case PictureStyle::kFlat:
      return FlatColours(layers);
    case PictureStyle::kToon:
    case PictureStyle::kWatercolour:
      return ToonColours(layers, choice);
    case PictureStyle::kInk:
      return FlatColours(layers);
    case PictureStyle::kHalftone:
      return choice.screens == ScreenKind::kShadows ? FlatColours(layers) : SmoothColours(layers, choice);
    case PictureStyle::kClay:
      return SmoothColours(WithClay(layers, choice.clay), choice);
    case PictureStyle::kSmooth:
    case PictureStyle::kPainterly:
    case PictureStyle::kPencil:
      break;
  }
  return SmoothColours(layers, choice);
}

/// Contrast about the middle, brightness, tint, saturation; one pass.
void Grade(ColourPlanes& colours, const StyleChoice& choice) {
  const bool is_plain = choice.saturation == 1 && choice.contrast == 1 && choice.brightness == 0 &&
                        choice.tint == std::array<float, 3>{1, 1, 1};
  if (is_plain) return;
  for (size_t i = 0; i < colours[0].values.size(); ++i) {
    std::array<float, 3> value{};
    for (int channel = 0; channel < 3; ++channel) {
      const float graded = (colours[channel].values[i] - 0.5f) * choice.contrast + 0.5f + choice.brightness;
      value[channel] = std::clamp(graded, 0.0f, 1.0f);
    }
    const float grey = 0.299f * value[0] + 0.587f * value[1] + 0.114f * value[2];
    for (int channel = 0; channel < 3; ++channel) {
      // A grey picture has no tint.
      const float tint = choice.saturation > 0 ? choice.tint[channel] : 1.0f;
      colours[channel].values[i] = (grey + choice.saturation * (value[channel] - grey)) * tint;
    }
  }
}

}  // namespace

Image DrawStyled(const PictureBuffers& buffers, const StyleChoice& choice, Rng& rng) {
  const PictureLayers layers = MakePictureLayers(buffers);
  MediumInput input;
  input.colours = DrawBackground(choice.background, layers.height, layers.width, rng);
  LayOverBackground(layers, SurfaceColours(layers, choice), input.colours);
  input.ink = DrawPictureLines(buffers, layers, choice, rng);
  ColourPlanes picture;
  switch (choice.style) {
    case PictureStyle::kPainterly:
      // A painter's lines are paint, too.
      InkOver(input.colours, input.ink, choice);
      picture = BrushPainting(input.colours, choice.brush * layers.scale, rng);
      break;
    case PictureStyle::kPencil:
      picture = PencilDrawing(input, layers, choice, rng);
      break;
    case PictureStyle::kInk:
      picture = InkDrawing(input, layers, choice, rng);
      break;
    case PictureStyle::kWatercolour:
      picture = Watercolour(input, layers, choice, rng);
      break;
    case PictureStyle::kHalftone:
      picture = HalftonePrint(input, layers, choice);
      break;
    case PictureStyle::kSmooth:
    case PictureStyle::kToon:
    case PictureStyle::kFlat:
    case PictureStyle::kClay:
      picture = std::move(input.colours);
      InkOver(picture, input.ink, choice);
      break;
  }
  Grade(picture, choice);
  return ToImage(picture);
}

}  // namespace daumier::render
