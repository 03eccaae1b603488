#pragma once
#include "core/options.h"
#include "core/random.h"
#include "render/styles/backgrounds.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace daumier::render {

/// How a picture is made, before lines, colour grade and background.
enum class PictureStyle {
  kSmooth,       ///< Soft light, gloss, occlusion: the look of a 3-D animation film.
  kToon,         ///< Few bands of light with hue-shifted shadows.
  kFlat,         ///< One colour a region.
  kInk,          ///< Black on paper: lines, solid blacks, few hatches.
  kPainterly,    ///< Brush strokes along the forms.
  kPencil,       ///< Hatching and grain on paper, grey or coloured.
  kWatercolour,  ///< Washes with dark edges and paper grain.
  kHalftone,     ///< Comic print: flat colours and screens of dots.
  kClay,         ///< One material for all: an untextured rendering.
};
inline constexpr int kNumPictureStyles = 9;

/// "smooth", "toon", "flat", "ink", "painterly", "pencil", "watercolour", "halftone", "clay".
std::string_view NameOf(PictureStyle style);

/// Which ink lines are drawn.
enum class LineSource {
  kNone,
  kBuffers,  ///< Borders of things, steps of depth, valleys of the normals.
  kStrokes,  ///< PictureBuffers::lines, and borders of things. Without lines there: as kBuffers.
};

/// What the dots of a halftone print are for.
enum class ScreenKind {
  kBlack,    ///< Black dots on paper.
  kShadows,  ///< Dots of shadow over flat colours.
  kProcess,  ///< Cyan, magenta, yellow and black.
};

/// Everything that is random about a style but its noise: plain data. Lengths are pixels of a picture 224 high; they
/// scale with the picture's height.
struct StyleChoice {
  PictureStyle style = PictureStyle::kSmooth;

  // Light: smooth, painterly, pencil, clay; toon, watercolour, halftone and ink use `shadows` too.
  float key = 0.25f;                                  ///< Strength of an added soft key light along MainLight, 0..1.
  float rim = 0.3f;                                   ///< Strength of light from behind at silhouettes, 0..1.
  float gloss = 0.5f;                                 ///< Scale of highlights on skin, eyes, hair and lips, 0..1.
  float occlusion = 0.4f;                             ///< Darkening of what lies behind its surroundings, 0..1.
  float shadows = 0.3f;                               ///< Darkness of shadows cast in the main light, 0..1.
  float warm_shade = 0.5f;                            ///< Reddening of skin where the light fades, 0..1.
  std::array<float, 3> clay = {0.75f, 0.72f, 0.69f};  ///< RGB albedo of kClay.

  // Bands: toon, watercolour, halftone.
  int bands = 2;                                            ///< Levels of light, 2..4.
  float band_softness = 0.05f;                              ///< Width of a step, as a share of the range of light.
  float band_depth = 0.35f;                                 ///< Darkening from the lightest to the darkest band.
  std::array<float, 3> shadow_hue = {0.95f, 0.80f, 0.95f};  ///< Tint of the darkest band, largest channel <= 1.

  // Media.
  float brush = 3;                                     ///< Painterly: width of a stroke, pixels.
  ScreenKind screens = ScreenKind::kShadows;           ///< Halftone.
  float screen = 4.5f;                                 ///< Halftone: distance of dots, pixels. Pencil: of hatches.
  float angle = 0.6f;                                  ///< Of hatches and screens, radians.
  float coloured = 1;                                  ///< Pencil, ink: 0 black on paper, 1 in colours.
  std::array<float, 3> paper = {0.97f, 0.96f, 0.93f};  ///< Pencil, watercolour, ink.

  // Lines.
  LineSource lines = LineSource::kNone;
  float line_width = 1.4f;      ///< Greatest width, pixels.
  float line_variation = 0.5f;  ///< 0: one width; 1: thin lines fade out.
  float line_wobble = 0.3f;     ///< Deviation of the hand, pixels.
  float line_tint = 0;          ///< 0: `line_colour`; 1: dark shade of what is drawn.
  std::array<float, 3> line_colour = {0.07f, 0.06f, 0.07f};

  // Grade of the finished picture.
  float saturation = 1;                   ///< 0: grey, equal channels.
  float contrast = 1;                     ///< About the middle, 0.5.
  float brightness = 0;                   ///< Added, 1 is white.
  std::array<float, 3> tint = {1, 1, 1};  ///< Factor of each channel.

  BackgroundChoice background;
};

/// "toon", or "toon_grey" where saturation is 0.
std::string StyleName(const StyleChoice& choice);

/// Whether the style draws PictureBuffers::lines where there are some, so that a builder need not make them for others.
bool UsesStrokes(const StyleChoice& choice);

/// Shares of styles among pictures; they are divided by their sum.
struct StyleOptions {
  double smooth = 0.26;
  double toon = 0.20;
  double flat = 0.10;
  double ink = 0.05;
  double painterly = 0.13;
  double pencil = 0.08;
  double watercolour = 0.06;
  double halftone = 0.06;
  double clay = 0.06;
  double grey = 0.08;
  double lines = 0.75;
  double strokes = 0.33;
  double busy_background = 0.6;

  template <class V>
  void Visit(V&& visit) {
    visit("smooth", smooth, Range{0, 1}, "Share of smooth pictures, as of a 3-D animation film.");
    visit("toon", toon, Range{0, 1}, "Share of pictures with few bands of light.");
    visit("flat", flat, Range{0, 1}, "Share of pictures with one colour a region.");
    visit("ink", ink, Range{0, 1}, "Share of pen drawings: lines, blacks and hatches.");
    visit("painterly", painterly, Range{0, 1}, "Share of paintings with visible brush strokes.");
    visit("pencil", pencil, Range{0, 1}, "Share of pencil drawings, grey and coloured.");
    visit("watercolour", watercolour, Range{0, 1}, "Share of watercolours.");
    visit("halftone", halftone, Range{0, 1}, "Share of comic prints with screens of dots.");
    visit("clay", clay, Range{0, 1}, "Share of untextured renderings.");
    visit("grey", grey, Range{0, 1}, "Share of grey pictures within each style.");
    visit("lines", lines, Range{0, 1},
          "Share of toon, flat and halftone pictures and watercolours with ink lines; a fifth of it of paintings.");
    visit("strokes", strokes, Range{0, 1}, "Share of pictures with lines that draw contours of the surface as lines.");
    visit("busy_background", busy_background, Range{0, 1},
          "Share of backgrounds with something in them: textures, scenes, patterns.");
  }
};

/// The style of one picture. @throws UsageError if all shares of styles are 0.
StyleChoice DrawStyleChoice(Rng& rng, const StyleOptions& options);

}  // namespace daumier::render
